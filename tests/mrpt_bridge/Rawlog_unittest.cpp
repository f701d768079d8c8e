/** RawlogWriter, RawlogReader and RawlogInfo on files. */
#include "mrpt_bridge/Observations.h"
#include "mrpt_bridge/RawlogInfo.h"
#include "mrpt_bridge/RawlogReader.h"
#include "mrpt_bridge/RawlogWriter.h"
#include "mrpt_bridge/RecordingHeaderJson.h"
#include "mrpt_bridge/registerClasses.h"
#include "someScan.h"
#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CRawlog.h>

#include <unistd.h>
#include <filesystem>
#include <fstream>

namespace scanloom
{
namespace
{
namespace fs = std::filesystem;

constexpr std::int64_t kStart = 1'700'000'000'000'000'000;
const Rigid kBodyTImu = Rigid::fromXyzYawPitchRoll(0.1, 0.2, 0.3, 0, 0, 0);

class Rawlog : public testing::Test
{
 protected:
  /** `scans` scans of 120 points, each with two IMU samples. */
  fs::path written(int scans, const RawlogOptions& options = {}, CloudClass cloud = CloudClass::CGenericPointsMap)
  {
    RawlogWriter writer(path_, someHeader(), options);
    for (int i = 0; i < scans; i++)
    {
      const Timestamp start = fromNanoseconds(kStart) + i * 100ms;
      writer.write(*toObservation(someScan(start), cloud));
      writer.write(*toObservation(ImuSample{start + 10ms, {1, 2, 3}, {4, 5, 6}}, kBodyTImu));
      writer.write(*toObservation(ImuSample{start + 60ms, {1, 2, 3}, {4, 5, 6}}, kBodyTImu));
    }
    writer.close();
    return path_;
  }

  std::string bytes() const
  {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  void overwrite(const std::string& content) const { std::ofstream(path_, std::ios::binary) << content; }

  TemporaryFolder folder_;
  fs::path path_ = folder_ / "some.rawlog";
};

int scansIn(RawlogReader& reader)
{
  int scans = 0;
  while (const auto event = reader.next()) scans += std::holds_alternative<RecordedScan>(*event);
  return scans;
}
}  // namespace

TEST_F(Rawlog, givesBackScansAndSamplesWholeAndInOrder)
{
  RawlogReader reader(written(3));
  ASSERT_TRUE(reader.header());
  EXPECT_EQ(reader.header()->lidars.at(1).name, "right");

  std::string order;
  int scans = 0;
  while (const auto event = reader.next())
  {
    if (const auto* recorded = std::get_if<RecordedScan>(&*event))
    {
      order += 's';
      EXPECT_EQ(recorded->label, "lidar");
      EXPECT_EQ(recorded->scan.start, fromNanoseconds(kStart) + scans++ * 100ms);
      EXPECT_EQ(recorded->scan.period, 100ms);
      EXPECT_EQ(recorded->scan.points.x, someScan({}).points.x);
    }
    if (const auto* imu = std::get_if<RecordedImu>(&*event))
    {
      order += 'i';
      EXPECT_EQ(imu->sample.accel, Eigen::Vector3d(4, 5, 6));
    }
  }
  EXPECT_EQ(order, "iisiisiis") << "a scan after the IMU samples of its period, though they were written after it";
  EXPECT_EQ(reader.damage(), "");
}

TEST_F(Rawlog, isReadByMrptsOwnLoader)
{
  registerClasses();  // as the plugin does in the stock applications
  mrpt::obs::CRawlog rawlog;
  ASSERT_TRUE(rawlog.loadFromRawLogFile(written(3).string()));

  std::string comment;
  rawlog.getCommentText(comment);
  EXPECT_TRUE(recordingHeaderFromJson(comment)) << "MRPT takes the comment for the log's own: " << comment;
  ASSERT_EQ(rawlog.size(), 9u);
  const auto cloud = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(rawlog.getAsObservation(6));
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->pointcloud->size(), 120u);
}

TEST_F(Rawlog, holdsTheHeaderEvenIfNothingElse)
{
  RawlogReader reader(written(0));
  EXPECT_TRUE(reader.header());
  EXPECT_FALSE(reader.next());
}

TEST_F(Rawlog, hasItsNameOnlyWhenItIsWhole)
{
  {
    RawlogWriter writer(path_, someHeader());
    writer.write(*toObservation(someScan(fromNanoseconds(kStart))));
    EXPECT_FALSE(fs::exists(path_));
  }
  EXPECT_FALSE(fs::exists(path_));
  RawlogReader abandoned(path_.string() + ".part");
  EXPECT_EQ(scansIn(abandoned), 1);
}

TEST_F(Rawlog, leavesAnOlderFileAloneUntilTheNewOneIsWhole)
{
  written(1);
  {
    RawlogWriter interrupted(path_, someHeader());
    interrupted.write(*toObservation(someScan(fromNanoseconds(kStart))));
  }
  EXPECT_EQ(rawlogInfo(path_).observations(), 3u);
}

TEST_F(Rawlog, saysWhichFileItCouldNotOpen)
{
  const auto expectNamed = [](const auto& open)
  {
    try
    {
      open();
      FAIL() << "opened";
    }
    catch (const std::runtime_error& e)
    {
      EXPECT_NE(std::string(e.what()).find("nowhere"), std::string::npos) << e.what();
    }
  };
  expectNamed([&] { RawlogReader(folder_ / "nowhere" / "x.rawlog"); });
  expectNamed([&] { RawlogWriter(folder_ / "nowhere" / "x.rawlog", {}); });
}

TEST_F(Rawlog, saysSoWhenTheDiskIsFull)
{
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  fs::create_symlink("/dev/full", path_.string() + ".part");
  EXPECT_THROW(
      {
        RawlogWriter writer(path_, someHeader());
        writer.write(*toObservation(someScan({})));
        writer.close();
      },
      std::runtime_error);
}

TEST_F(Rawlog, isReadUpToWhereItWasCut)
{
  written(20, {0});
  const std::string whole = bytes();
  int last = -1;
  for (const double share : {0.02, 0.3, 0.6, 0.95})
  {
    overwrite(whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    RawlogReader reader(path_);
    const int scans = scansIn(reader);
    EXPECT_GE(scans, static_cast<int>(20 * share) - 2);
    EXPECT_LT(scans, 20);
    EXPECT_GT(scans, last);
    EXPECT_NE(reader.damage(), "") << "cut at " << share;
    last = scans;
  }
}

TEST_F(Rawlog, isReadUpToWhereItWasDamaged)
{
  written(20, {1});
  std::string damaged = bytes();
  for (std::size_t i = 0; i < 64; i++) damaged[damaged.size() / 2 + i] ^= 0x5A;
  overwrite(damaged);

  RawlogReader reader(path_);
  EXPECT_LT(scansIn(reader), 20);
  EXPECT_NE(reader.damage(), "");
  EXPECT_NE(rawlogInfo(path_).damage, "");
}

TEST_F(Rawlog, cutWithinItsLastCheckSumIsStillSaidToBeCut)
{
  written(2, {0});
  overwrite(bytes().substr(0, bytes().size() - 4));

  RawlogReader reader(path_);
  EXPECT_EQ(scansIn(reader), 2);
  EXPECT_NE(reader.damage(), "");
}

TEST_F(Rawlog, thatIsNoneIsSaidToBeDamaged)
{
  overwrite("this is no rawlog, but a text about one\n");
  RawlogReader reader(path_);
  EXPECT_FALSE(reader.header());
  EXPECT_FALSE(reader.next());
  EXPECT_NE(reader.damage(), "");
}

TEST_F(Rawlog, isCountedByLabelAndClass)
{
  const RawlogInfo info = rawlogInfo(written(4));

  ASSERT_EQ(info.sensors.size(), 2u);
  EXPECT_EQ(info.sensors[0].label, "imu");
  EXPECT_EQ(info.sensors[0].count, 8u);
  EXPECT_EQ(info.sensors[0].observation_class, "mrpt::obs::CObservationIMU");
  EXPECT_EQ(info.sensors[1].label, "lidar");
  EXPECT_EQ(info.sensors[1].count, 4u);
  EXPECT_EQ(info.sensors[1].points, 480u);
  EXPECT_EQ(info.sensors[1].cloud_class, "mrpt::maps::CGenericPointsMap");
  EXPECT_EQ(info.observations(), 12u);
  EXPECT_EQ(info.points(), 480u);
  EXPECT_EQ(info.span(), 360ms) << "from the first scan's start to the last IMU sample";
  EXPECT_EQ(info.file_size, fs::file_size(path_));
  ASSERT_TRUE(info.header);
  EXPECT_EQ(info.header->scan_rate, 10);
}

TEST_F(Rawlog, holdsXyziCloudsIfAskedTo)
{
  const RawlogInfo info = rawlogInfo(written(1, {}, CloudClass::CPointsMapXYZI));
  EXPECT_EQ(info.sensors.at(1).cloud_class, "mrpt::maps::CPointsMapXYZI");
}
}  // namespace scanloom
