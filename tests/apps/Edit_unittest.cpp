/** `scanloom edit` as a person meets it. */
#include "dataset/CloudObservation.h"
#include "dataset/smallRawlog.h"
#include "support/TestData.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace scanloom
{
namespace
{
using testing::HasSubstr;

Ended edit(const std::string& arguments, const std::string& redirection = "2>&1")
{
  return runProgram(SCANLOOM_BIN_DIR "/scanloom edit " + arguments + " " + redirection);
}

struct Edit : testing::Test
{
  TemporaryFolder folder;
  const std::string in = writeSmallRawlog(folder / "in.rawlog").string();
  const std::string out = (folder / "out.rawlog").string();
  const std::string files = "-i " + in + " -o " + out + " ";
};

TEST_F(Edit, splitsAndMergesToTheSameBytes)
{
  ASSERT_EQ(edit(files + "--split-lidars").status, 0);
  const std::string merged = (folder / "merged.rawlog").string();
  ASSERT_EQ(edit("-i " + out + " -o " + merged + " --merge-lidars").status, 0);
  EXPECT_TRUE(uncompressed(merged) == uncompressed(in));
}

TEST_F(Edit, countsByLabelAsJson)
{
  const auto json = nlohmann::json::parse(edit(files + "--keep-every 2 --json", "2>/dev/null").output);
  EXPECT_EQ(json["labels"]["lidar"]["read"], 4);
  EXPECT_EQ(json["labels"]["lidar"]["written"], 2);
  EXPECT_EQ(json["damage"], "");
}

TEST_F(Edit, aDamagedFileIsStatus3WithTheRecoveredPartWritten)
{
  std::filesystem::resize_file(in, std::filesystem::file_size(in) / 2);
  const Ended ended = edit(files + "--keep-every 1");
  EXPECT_EQ(ended.status, 3);
  EXPECT_THAT(ended.output, HasSubstr("damaged: after"));
  EXPECT_GT(observationsIn(out).size(), 2u);
}

TEST_F(Edit, oneOperationACall)
{
  EXPECT_EQ(edit(files).status, 2);
  const Ended two = edit(files + "--split-lidars --voxel 1");
  EXPECT_EQ(two.status, 2);
  EXPECT_THAT(two.output, HasSubstr("not --split-lidars, --voxel"));
}

TEST_F(Edit, aCutMayGoBeforeAnOperation)
{
  ASSERT_EQ(edit(files + "--from-time 1700000000.1 --to-time 1700000000.3 --split-lidars").status, 0);
  EXPECT_EQ(observationsIn(out, "lidar_left").size(), 3u);
}

TEST_F(Edit, doesNotReplaceUnasked)
{
  ASSERT_EQ(edit(files + "--keep-every 1").status, 0);
  EXPECT_EQ(edit(files + "--keep-every 1").status, 2);
  EXPECT_EQ(edit(files + "--keep-every 1 -w").status, 0);
}

TEST_F(Edit, aDryRunChecksAndWritesNothing)
{
  const Ended ended = edit(files + "--keep-lidars left --dry-run");
  EXPECT_EQ(ended.status, 0);
  EXPECT_THAT(ended.output, HasSubstr("--keep-lidars"));
  EXPECT_FALSE(std::filesystem::exists(out));
  EXPECT_EQ(edit(files + "--keep-lidars lfet --dry-run").status, 2);
}

TEST_F(Edit, whatIsNoValueIsStatus2)
{
  for (const std::string operation : {"--crop-box '0 0 0 1 1'", "--crop-box '0 0 0 1 1 -1'", "--voxel 0",
                                      "--time-offset imu", "--time-offset imu=soon", "--from-time yesterday",
                                      "--from-index 5 --to-index 4", "--min-range 5 --max-range 4"})
    EXPECT_EQ(edit(files + operation).status, 2) << operation;
}

TEST_F(Edit, anInputThatIsMissingIsStatus1)
{
  EXPECT_EQ(edit("-i nowhere.rawlog -o " + out + " --keep-every 2").status, 1);
}

TEST_F(Edit, exportsIntoAFolderThatIsEmptyOrOverwritten)
{
  const std::string folder_of_clouds = " --export-pcd " + (folder / "clouds").string();
  ASSERT_EQ(edit("-i " + in + folder_of_clouds).status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "clouds/lidar/000003.pcd"));
  EXPECT_EQ(edit("-i " + in + folder_of_clouds).status, 2);
  EXPECT_EQ(edit("-i " + in + folder_of_clouds + " -w").status, 0);
  EXPECT_EQ(edit(files + folder_of_clouds + " -w").status, 2) << "-o is not for exports";
}

TEST_F(Edit, checksAndInforms)
{
  const auto checked = nlohmann::json::parse(edit("-q -i " + in + " --check --json", "2>/dev/null").output);
  EXPECT_EQ(checked["rawlog"]["labels"]["lidar"]["count"], 4);
  EXPECT_FALSE(checked["findings"].empty());
  const auto informed = nlohmann::json::parse(edit("-i " + in + " --info --json", "2>/dev/null").output);
  EXPECT_EQ(informed["header"]["scanloom"]["lidars"].size(), 2u);
  EXPECT_EQ(edit("-i " + in + " --check --from-index 3").status, 2) << "a check is of the whole file";
}

TEST_F(Edit, aCheckOfADamagedFileIsStatus3)
{
  std::filesystem::resize_file(in, std::filesystem::file_size(in) * 2 / 3);
  EXPECT_EQ(edit("-i " + in + " --check").status, 3);
}

TEST_F(Edit, mapsNeedATrajectory)
{
  const Ended ended = edit("-i " + in + " --to-octomap " + (folder / "m.bt").string());
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.output, HasSubstr("--trajectory"));
}

TEST_F(Edit, deskewsByTheImuThatIsNamedAndSaysWhatItKnowsOfItsBias)
{
  const Ended without = edit(files + "--deskew imu");  // 60 deg/s and more throughout: never at rest
  EXPECT_EQ(without.status, 0) << without.output;
  EXPECT_THAT(without.output, HasSubstr("warning: 'imu' is never at rest"));
  EXPECT_EQ(observationsIn(out, "lidar").size(), 4u);
  EXPECT_THAT(edit(files + "-w --deskew imu --imu imu_left").output, HasSubstr("known are 'imu' and 'imu_right'"));
  EXPECT_EQ(edit(files + "-w --voxel 1 --imu imu_right").status, 2) << "without --deskew imu";
}

/** The same two poses, 5 ms before the first scan and 245 ms after its start, at 10 m/s along x. */
TEST_F(Edit, deskewsAlongTrajectoriesOfAllThreeFormats)
{
  std::ofstream(folder / "t.tum") << "1699999999.995 0 0 0 0 0 0 1\n1700000000.245 2.5 0 0 0 0 0 1\n";
  std::ofstream(folder / "t.csv") << "#timestamp,x,y,z,qw,qx,qy,qz\n1699999999995000000,0,0,0,1,0,0,0\n"
                                     "1700000000245000000,2.5,0,0,1,0,0,0\n";
  std::ofstream(folder / "t.txt") << "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 2.5 0 1 0 0 0 0 1 0\n";
  std::ofstream(folder / "times.txt") << "1699999999.995\n1700000000.245\n";
  for (const std::string name : {"t.tum", "t.csv", "t.txt"})
  {
    const std::string trajectory = (folder / name).string();
    ASSERT_EQ(edit(files + "-w --deskew " + trajectory).status, 0) << name;
    const Observations clouds = observationsIn(out, "lidar");
    ASSERT_EQ(clouds.size(), 2u) << name;
    EXPECT_NEAR(positionsInBody(*cloudIn(clouds[0]))[4].x(), 0.4f + 10 * 2.441403e-3f, 1e-5) << name;
    const std::string map = (folder / (name + ".simplemap")).string();
    EXPECT_EQ(edit("-i " + in + " --to-simplemap " + map + " --trajectory " + trajectory).status, 0) << name;
  }
}

TEST_F(Edit, aTrajectoryThatCoversNoScanIsAnErrorThatNamesBothTimes)
{
  std::ofstream(folder / "other.tum") << "1600000000 0 0 0 0 0 0 1\n1600000100 2.5 0 0 0 0 0 1\n";
  const Ended ended = edit(files + "--deskew " + (folder / "other.tum").string());
  EXPECT_EQ(ended.status, 1);
  EXPECT_THAT(ended.output, HasSubstr("none of 4 clouds (1700000000.0"));
  EXPECT_THAT(ended.output, HasSubstr("the trajectory (1600000000.000000000 s to 1600000100.000000000 s)"));
  EXPECT_FALSE(std::filesystem::exists(out));

  std::ofstream(folder / "empty.tum") << "# stamp x y z qx qy qz qw\n";
  EXPECT_NE(edit(files + "--deskew " + (folder / "empty.tum").string()).status, 0);
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(Edit, capturesGiveTheSameBytesAsRecordDoes)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const std::string configuration = " -c " SCANLOOM_SOURCE_DIR "/params/dual_os0_recording.ini";
  const std::string with_recording = "SCANLOOM_RECORDING=" + recording.string() + " " SCANLOOM_BIN_DIR "/scanloom ";
  const std::string recorded = (folder / "recorded.rawlog").string();
  ASSERT_EQ(runProgram(with_recording + "record" + configuration + " -o " + recorded + " 2>&1").status, 0);

  const std::string capture = " --from-pcap " + (recording / "recording.pcap").string();
  ASSERT_EQ(runProgram(with_recording + "edit" + capture + configuration + " -o " + out + " 2>&1").status, 0);
  EXPECT_EQ(runProgram("gunzip -c < " + out + " | md5sum").output,
            runProgram("gunzip -c < " + recorded + " | md5sum").output);

  const std::string turns = (folder / "turns.rawlog").string();
  ASSERT_EQ(
      runProgram(with_recording + "edit --approach-a" + capture + configuration + " -o " + turns + " 2>&1").status, 0);
  EXPECT_NE(runProgram("gunzip -c < " + turns + " | md5sum").output,
            runProgram("gunzip -c < " + out + " | md5sum").output);
}
}  // namespace
}  // namespace scanloom
