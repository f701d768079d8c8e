/**
 * Recordings as strangers have them: one drive, altered as public reports describe it. Each is right, that is the same
 * as the drive to the bit, or said, with status 3.
 */
#include "support/TemporaryFolder.h"
#include "support/runProgram.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace scanloom::field_unittest
{
namespace
{
using testing::HasSubstr;
namespace fs = std::filesystem;

Ended scanloom(const fs::path& in, const std::string& command)
{
  return runProgram(fmt::format("cd {} && {}/scanloom {} 2>&1", in.string(), SCANLOOM_BIN_DIR, command));
}

/** Two small lidars and an IMU, 8 s in a sparse stand; simulated once. */
class Strangers : public testing::Test
{
 protected:
  static void SetUpTestSuite()
  {
    world_ = std::make_unique<TemporaryFolder>();
    const Ended simulated = scanloom(
        world_->path(), "simulate -c " SCANLOOM_SOURCE_DIR
                        "/params/simulation/sparse.ini --seed 3 --set simulated_drive.duration=8 --out-dir drive --set "
                        "simulated_lidars.lidar1_model=OS0-32 --set simulated_lidars.lidar2_model=OS0-32");
    ASSERT_EQ(simulated.status, 0) << simulated.output;
    for (const char* other : {"drive/groundtruth.tum", "drive/total_station.csv", "drive/objects.csv"})
      fs::remove(*world_ / other);
    const Ended right = slam("drive");
    ASSERT_EQ(right.status, 0) << right.output;
    trajectory_ = contentOf(*world_ / "drive_slam/trajectory.tum");
  }
  static void TearDownTestSuite() { world_.reset(); }

  static Ended slam(const std::string& recording)
  {
    return scanloom(world_->path(), fmt::format("slam {} --every-nth 5 -w --set output.maps=false", recording));
  }

  /** A copy of the drive's folder, one file of which `alter` writes anew. */
  static void altered(const std::string& name, const std::string& file,
                      const std::function<std::string(std::string)>& alter)
  {
    fs::copy(*world_ / "drive", *world_ / name);
    std::string content = alter(contentOf(*world_ / name / file));
    std::ofstream(*world_ / name / file, std::ios::binary) << content;
  }

  static void expectRight(const std::string& name, const std::string& conclusion)
  {
    const Ended ended = slam(name);
    EXPECT_EQ(ended.status, 0) << ended.output;
    EXPECT_THAT(ended.output, HasSubstr(conclusion));
    EXPECT_EQ(contentOf(*world_ / (name + "_slam") / "trajectory.tum"), trajectory_);
  }

  static void expectSaid(const std::string& name, const std::string& what)
  {
    const Ended ended = slam(name);
    EXPECT_EQ(ended.status, 3) << ended.output;
    EXPECT_THAT(ended.output, HasSubstr(what));
  }

  inline static std::unique_ptr<TemporaryFolder> world_;
  inline static std::string trajectory_;
};

/** Calls `change` with seconds and fraction of each record of a pcap. */
std::string withStamps(std::string pcap, const std::function<void(std::uint32_t&, std::uint32_t&)>& change)
{
  for (std::size_t at = 24; at + 16 <= pcap.size();)
  {
    std::uint32_t second = 0, fraction = 0, length = 0;
    std::memcpy(&second, pcap.data() + at, 4);
    std::memcpy(&fraction, pcap.data() + at + 4, 4);
    std::memcpy(&length, pcap.data() + at + 8, 4);
    change(second, fraction);
    std::memcpy(pcap.data() + at, &second, 4);
    std::memcpy(pcap.data() + at + 4, &fraction, 4);
    at += 16 + length;
  }
  return pcap;
}

bool isOfNanoseconds(const std::string& pcap) { return pcap.substr(0, 4) == "\x4d\x3c\xb2\xa1"; }

TEST_F(Strangers, captureWithTimesOfReceptionAThousandTimesTooFast)
{
  altered("fast", "recording.pcap",
          [](const std::string& pcap)
          {
            const std::uint64_t per_second = isOfNanoseconds(pcap) ? 1'000'000'000 : 1'000'000;
            std::uint64_t first = 0;
            return withStamps(pcap,
                              [&](std::uint32_t& second, std::uint32_t& fraction)
                              {
                                std::uint64_t time = second * per_second + fraction;
                                if (first == 0) first = time;
                                time = first + 1000 * (time - first);
                                second = static_cast<std::uint32_t>(time / per_second);
                                fraction = static_cast<std::uint32_t>(time % per_second);
                              });
          });
  expectRight("fast", "1000 times as fast");
}

TEST_F(Strangers, folderWithANameOfLatin1)
{
  altered(
      "Tr\xe4"
      "ger",
      "extrinsics.txt", [](const std::string& same) { return same; });
  expectRight(
      "Tr\xe4"
      "ger",
      "OK");
}

TEST_F(Strangers, captureOfMicrosecondsThatHoldsNanoseconds)
{
  altered("nanoseconds", "recording.pcap",
          [](const std::string& pcap)
          {
            const std::uint32_t scale = isOfNanoseconds(pcap) ? 1 : 1000;
            return "\xd4\xc3\xb2\xa1" +
                   withStamps(pcap, [scale](std::uint32_t&, std::uint32_t& fraction) { fraction *= scale; }).substr(4);
          });
  expectRight("nanoseconds", "OK");
}

std::vector<std::vector<std::string>> rowsOf(const std::string& csv)
{
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);)
  {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

TEST_F(Strangers, imuAsRostopicEchoPrintsIt)
{
  altered("echo", "imu.csv",
          [](const std::string& csv)
          {
            std::string text =
                "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.angular_velocity.x,"
                "field.angular_velocity.y,field.angular_velocity.z,field.linear_acceleration.x,"
                "field.linear_acceleration.y,field.linear_acceleration.z\n";
            for (const auto& row : rowsOf(csv))
              text += fmt::format("{0},7,{0},imu,{1}\n", row[0], fmt::join(row.begin() + 1, row.end(), ","));
            return text;
          });
  expectRight("echo", "OK");
}

TEST_F(Strangers, imuInSecondsWithAHeading)
{
  altered("seconds", "imu.csv",
          [](const std::string& csv)
          {
            std::string text = "time,gyro_x,gyro_y,gyro_z,acc_x,acc_y,acc_z\n";
            for (const auto& row : rowsOf(csv))
              text += fmt::format("{}.{},{}\n", row[0].substr(0, row[0].size() - 9), row[0].substr(row[0].size() - 9),
                                  fmt::join(row.begin() + 1, row.end(), ","));
            return text;
          });
  expectRight("seconds", "taken as s");
}

TEST_F(Strangers, imuWithALineTwice)
{
  altered("twice", "imu.csv",
          [](const std::string& csv)
          {
            const std::size_t end = csv.find('\n', csv.size() / 2), begin = csv.rfind('\n', end - 1);
            return csv.substr(0, end) + csv.substr(begin, end - begin) + csv.substr(end);
          });
  expectRight("twice", "1 samples are there twice: left out");
}

TEST_F(Strangers, imuOfUnknownColumns)
{
  altered("unknown", "imu.csv", [](const std::string&) { return "x,y\n1,2\n"; });
  expectSaid("unknown", "imu.csv: no table of an IMU");
}

TEST_F(Strangers, metadataOfOneLidarThatContradictThemselves)
{
  altered("metadata", "left.json",
          [](const std::string& text)
          {
            nlohmann::json metadata = nlohmann::json::parse(text);
            const nlohmann::json paths = metadata.flatten();
            const std::string first = "/beam_altitude_angles/0";
            for (const auto& path : paths.items())
              if (const std::size_t at = path.key().find(first);
                  at != std::string::npos && at + first.size() == path.key().size())
                metadata.at(nlohmann::json::json_pointer(path.key().substr(0, path.key().size() - 2))).push_back(1.5);
            return metadata.dump();
          });
  expectSaid("metadata", "left.json: beam_altitude_angles");
  EXPECT_THAT(scanloom(world_->path(), "doctor metadata").output, HasSubstr("NOT FIT"));
  EXPECT_THAT(scanloom(world_->path(), "info metadata").output, HasSubstr("left.json: beam_altitude_angles"));
}

TEST_F(Strangers, whatRecordAndEditWroteIntoTheFolder)
{
  fs::copy(*world_ / "drive", *world_ / "own");
  const Ended recorded = scanloom(*world_ / "own", "record . -o drive.rawlog");
  ASSERT_EQ(recorded.status, 0) << recorded.output;
  const Ended exported = scanloom(*world_ / "own", "edit -q -i drive.rawlog --to-mcap drive.mcap");
  ASSERT_EQ(exported.status, 0) << exported.output;
  expectRight("own", ", drive.mcap, ");
  expectRight("own", ", drive.rawlog\n");
}

TEST_F(Strangers, twoLidarsWithoutPosesAreNotFit)
{
  fs::copy(*world_ / "drive", *world_ / "poseless");
  fs::remove(*world_ / "poseless/extrinsics.txt");
  fs::remove(*world_ / "poseless/imu.csv");
  const Ended ended = scanloom(world_->path(), "doctor poseless");
  EXPECT_EQ(ended.status, 3);
  EXPECT_THAT(ended.output, HasSubstr("not all poses of the lidars in the body frame are known"));
}

TEST_F(Strangers, captureThatIsAPointerOfGitLfs)
{
  altered("pointer", "recording.pcap",
          [](const std::string&) { return "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n"; });
  for (const char* recording : {"pointer", "pointer/recording.pcap"})
  {
    const Ended ended = slam(recording);
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.output, HasSubstr("git lfs pull"));
  }
}

TEST_F(Strangers, captureOfOnePacket)
{
  altered("packet", "recording.pcap",
          [](const std::string& pcap)
          {
            for (std::size_t at = 24;;)
            {
              std::uint32_t length = 0;
              std::memcpy(&length, pcap.data() + at + 8, 4);
              if (length > 1000) return pcap.substr(0, 24) + pcap.substr(at, 16 + length);
              at += 16 + length;
            }
          });
  expectSaid("packet", "NOTHING");
}

TEST_F(Strangers, mapInCoordinatesOfACountry)
{
  const Ended misnamed = scanloom(world_->path(), "record drive -o drive.bag");
  EXPECT_EQ(misnamed.status, 2);
  EXPECT_THAT(misnamed.output, HasSubstr("'record' writes a rawlog"));
  ASSERT_EQ(scanloom(world_->path(), "record drive -o drive.rawlog").status, 0);
  std::ofstream utm(*world_ / "utm.tum");
  std::istringstream poses(trajectory_);
  for (std::string line; std::getline(poses, line);)
  {
    std::istringstream words(line);
    std::string stamp, rest;
    double x = 0, y = 0;
    if (line.front() == '#' || !(words >> stamp >> x >> y)) continue;
    std::getline(words, rest);
    utm << fmt::format("{} {:.9f} {:.9f}{}\n", stamp, x + 512'345, y + 5'412'988, rest);
  }
  utm.close();
  const Ended ended =
      scanloom(world_->path(), "map -i drive.rawlog --trajectory utm.tum -o far.bt -o far.las -o far.ply");
  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("less 512000 5413000 0 m"));
  EXPECT_EQ(scanloom(world_->path(), "map -i drive.rawlog --trajectory drive_slam/trajectory.tum -o near.bt").status,
            0);
  EXPECT_GT(fs::file_size(*world_ / "far.bt"), fs::file_size(*world_ / "near.bt") / 2) << "no empty tree";
}

TEST_F(Strangers, keyframesGivenAsARecording)
{
  ASSERT_EQ(scanloom(world_->path(), "slam drive --every-nth 5 --out-dir maps").status, 0);
  const Ended ended = scanloom(world_->path(), "info maps/keyframes.simplemap");
  EXPECT_EQ(ended.status, 3);
  EXPECT_THAT(ended.output, HasSubstr("a map and no recording"));
}
}  // namespace
}  // namespace scanloom::field_unittest
