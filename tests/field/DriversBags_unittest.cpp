/**
 * Bags as other drivers write them, by what public reports of lidar drivers and odometries describe: of one drive,
 * right, that is where it is by the usual driver's bag, or said.
 */
#include "HallBag.h"
#include "base/formats/Trajectory.h"
#include "support/TemporaryFolder.h"
#include "support/runProgram.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <memory>
#include <random>

namespace scanloom::drivers_bags_unittest
{
namespace
{
using testing::HasSubstr;
using Messages = std::vector<HandmadeMessage>;
using hall_drive::kStart;
using hall_drive::kTurn;

/** How a driver writes a turn: its header's stamp, and its cloud. */
using WriteCloud = std::function<std::string(const HallDrive::Turn&)>;
using ChangeImu = std::function<void(ImuSample&)>;

std::vector<DriverField> withTime(const DriverField& time)
{
  std::vector<DriverField> fields = positions();
  fields.push_back(ringField());
  fields.push_back(time);
  return fields;
}

/** Seconds after `origin` (ns after the turn's start), as Velodyne's driver writes them. */
DriverField secondsAfter(std::uint32_t origin)
{
  return {"time", 7, [origin](const DriverPoint& p) {
            return littleEndian(static_cast<float>((static_cast<double>(p.after) - static_cast<double>(origin)) / 1e9));
          }};
}

std::string usualCloud(const HallDrive::Turn& turn)
{
  return cloudWith(withTime(secondsAfter(0)), turn.start, turn.points);
}

class DriversBags : public testing::Test
{
 protected:
  static void SetUpTestSuite()
  {
    world_ = std::make_unique<TemporaryFolder>();
    drive_ = std::make_unique<HallDrive>(driveThroughHall());
    write("usual", messages());
    const Ended right = slam("usual");
    ASSERT_EQ(right.status, 0) << right.output;
    last_ = lastPositionOf("usual");
    ASSERT_GT(last_.norm(), 5);
  }
  static void TearDownTestSuite() { world_.reset(), drive_.reset(); }

  static Messages messages(
      const WriteCloud& cloud = usualCloud, const ChangeImu& change = [](ImuSample&) {})
  {
    Messages all{{"/tf_static", "tf2_msgs/TFMessage", kStart, transformMessage("base_link", "lidar", 0)},
                 {"/tf_static", "tf2_msgs/TFMessage", kStart, transformMessage("base_link", "imu", 0)}};
    for (ImuSample sample : drive_->imu)
    {
      const auto received = static_cast<std::uint64_t>(nanoseconds(sample.stamp)) + 2'000'000;
      change(sample);
      all.push_back({"/imu/data", "sensor_msgs/Imu", received, imuOf(sample)});
    }
    for (const HallDrive::Turn& turn : drive_->turns)
      all.push_back({"/points", "sensor_msgs/PointCloud2", turn.start + kTurn + 1'000'000, cloud(turn)});
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.received < b.received; });
    return all;
  }

  static void write(const std::string& name, const Messages& bag)
  {
    std::filesystem::create_directory(*world_ / name);
    writeFile(*world_ / name / "drive.bag", ros1Of(bag));
  }

  static Ended slam(const std::string& name)
  {
    return runProgram(fmt::format("cd {} && {}/scanloom slam {} --every-nth 2 -w --set output.maps=false 2>&1",
                                  world_->path().string(), SCANLOOM_BIN_DIR, name));
  }

  static Eigen::Vector3d lastPositionOf(const std::string& name)
  {
    const Trajectory poses = readTum(*world_ / (name + "_slam") / "trajectory.tum");
    return poses.empty() ? Eigen::Vector3d::Zero() : poses.back().map_T_body.translation;
  }

  static void expectRight(const std::string& name)
  {
    const Ended ended = slam(name);
    EXPECT_EQ(ended.status, 0) << ended.output;
    EXPECT_LT((lastPositionOf(name) - last_).norm(), 0.05) << ended.output;
  }

  static void expectSaid(const std::string& name, const std::string& what)
  {
    const Ended ended = slam(name);
    EXPECT_NE(ended.status, 0) << ended.output;
    EXPECT_THAT(ended.output, HasSubstr(what));
  }

  inline static std::unique_ptr<TemporaryFolder> world_;
  inline static std::unique_ptr<HallDrive> drive_;
  inline static Eigen::Vector3d last_;  // m
};
}  // namespace

TEST_F(DriversBags, stampsAtTheEndOfTheTurnWithTimesBefore)
{
  write("before", messages([](const HallDrive::Turn& turn)
                           { return cloudWith(withTime(secondsAfter(kTurn)), turn.start + kTurn, turn.points); }));
  expectRight("before");
}

TEST_F(DriversBags, timesAsAbsoluteNanosecondsInDoubles)
{
  write("doubles", messages(
                       [](const HallDrive::Turn& turn)
                       {
                         const DriverField time{"timestamp", 8, [&](const DriverPoint& p) {
                                                  return littleEndian(static_cast<double>(turn.start + p.after));
                                                }};
                         return cloudWith(withTime(time), turn.start, turn.points);
                       }));
  expectRight("doubles");
}

TEST_F(DriversBags, cloudsWithoutRings)
{
  write("ringless", messages(
                        [](const HallDrive::Turn& turn)
                        {
                          std::vector<DriverField> fields = positions();
                          fields.push_back(secondsAfter(0));
                          return cloudWith(fields, turn.start, turn.points);
                        }));
  expectRight("ringless");
}

TEST_F(DriversBags, pointsInAnyOrder)
{
  std::mt19937 random(1);
  write("shuffled", messages(
                        [&](HallDrive::Turn turn)
                        {
                          std::shuffle(turn.points.begin(), turn.points.end(), random);
                          return usualCloud(turn);
                        }));
  expectRight("shuffled");
}

TEST_F(DriversBags, aDriveInFilesWhoseNumbersHaveNoZeros)
{
  const Messages all = messages();
  const auto half = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::filesystem::create_directory(*world_ / "split");
  writeFile(*world_ / "split" / "drive_9.bag", ros1Of({all.begin(), half}));
  writeFile(*world_ / "split" / "drive_10.bag", ros1Of({half, all.end()}));
  expectRight("split");
}

TEST_F(DriversBags, aCompressedCopyOfTheCloudsIsNamed)
{
  Messages all = messages();
  all.push_back({"/points/packed", "point_cloud_interfaces/CompressedPointCloud2", kStart + kTurn, "packed"});
  write("copy", all);
  expectRight("copy");
  EXPECT_THAT(slam("copy").output, HasSubstr("not used: topic /points/packed"));
}

TEST_F(DriversBags, cloudsWithoutTimes)
{
  write("timeless",
        messages([](const HallDrive::Turn& turn) { return cloudWith(positions(), turn.start, turn.points); }));
  expectSaid("timeless", "a cloud without field 't' or 'time'");
}

TEST_F(DriversBags, cloudsInMillimetres)
{
  write("millimetres", messages(
                           [](HallDrive::Turn turn)
                           {
                             for (DriverPoint& p : turn.points) p.x *= 1000, p.y *= 1000, p.z *= 1000;
                             return usualCloud(turn);
                           }));
  expectSaid("millimetres", "too far: are they in mm?");
}

TEST_F(DriversBags, anImuInG)
{
  write("g", messages(usualCloud, [](ImuSample& s) { s.accel /= 9.80665; }));
  expectSaid("g", "the values are in g");
}

TEST_F(DriversBags, anImuWithoutGravity)
{
  write("gravity", messages(usualCloud, [](ImuSample& s) { s.accel.z() -= 9.80665; }));
  expectSaid("gravity", "gravity was taken out by the IMU");
}

TEST_F(DriversBags, anImuThatHangsUpsideDown)
{
  write("down", messages(usualCloud,
                         [](ImuSample& s)
                         {
                           s.gyro = {s.gyro.x(), -s.gyro.y(), -s.gyro.z()};
                           s.accel = {s.accel.x(), -s.accel.y(), -s.accel.z()};
                         }));
  expectSaid("down", "up is along -z of the body");
}

TEST_F(DriversBags, anImuStampedAsItsBufferIsRead)
{
  write("bursts", messages(usualCloud,
                           [](ImuSample& s)
                           {
                             const Duration since = s.stamp - Timestamp{Duration{static_cast<std::int64_t>(kStart)}};
                             s.stamp += 50ms - since % 50ms;
                           }));
  expectSaid("bursts", "it is stamped as it arrives");
}

TEST_F(DriversBags, anImuThatCountsSinceItsStart)
{
  write("boot",
        messages(usualCloud, [](ImuSample& s) { s.stamp -= Duration{static_cast<std::int64_t>(kStart)} - 10s; }));
  expectSaid("boot", "its clock is another one");
}
}  // namespace scanloom::drivers_bags_unittest
