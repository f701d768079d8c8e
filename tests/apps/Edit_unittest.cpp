/** `scanloom edit` as a person meets it. */
#include "base/formats/Trajectory.h"
#include "mrpt/edit/smallRawlog.h"
#include "support/TestData.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace scanloom::edit_unittest
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
  ASSERT_EQ(edit(files + "--from-index 0 --split-lidars").status, 0) << "a cut may go before";
  const std::string merged = (folder / "merged.rawlog").string();
  ASSERT_EQ(edit("-i " + out + " -o " + merged + " --merge-lidars").status, 0);
  EXPECT_TRUE(uncompressed(merged) == uncompressed(in));
}

TEST_F(Edit, countsByLabel)
{
  EXPECT_THAT(edit(files + "--keep-every 2", "2>/dev/null").output, testing::ContainsRegex("lidar +4 -> 2\n"));
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

TEST_F(Edit, doesNotReplaceUnasked)
{
  ASSERT_EQ(edit(files + "--keep-every 1").status, 0);
  EXPECT_EQ(edit(files + "--keep-every 1").status, 2);
  EXPECT_EQ(edit(files + "--keep-every 1 -w").status, 0);
}

TEST_F(Edit, aLidarThatIsNotThereIsStatus2AndWritesNothing)
{
  EXPECT_EQ(edit(files + "--keep-lidars lfet").status, 2);
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(Edit, whatIsNoValueIsStatus2)
{
  for (const std::string operation :
       {"--crop-box '0 0 0 1 1'", "--crop-box '0 0 0 1 1 nan'", "--voxel 0", "--voxel nan", "--from-time yesterday",
        "--from-time nan", "--from-index -1", "--to-index -1", "--keep-every -1", "--rebatch nan", "--ranges '1 nan'",
        "--ranges 5", "--export las=x", "--export ply=", "--time-offset imu=nan"})
  {
    EXPECT_EQ(edit(files + operation).status, 2) << operation;
    EXPECT_FALSE(std::filesystem::exists(out)) << operation;
  }
}

TEST_F(Edit, anOutputIsNeverAnInput)
{
  const std::string before = contentOf(in);
  const std::string link = (folder / "link.rawlog").string();
  std::filesystem::create_symlink(in, link);
  const std::string path = (folder / "t.tum").string();
  writeTum(path, straightOn());
  for (const std::string& arguments : {" -o " + in + " --keep-every 2", " -o " + link + " --keep-every 2",
                                       " -o " + path + " --deskew " + path, " --export tum=" + in})
  {
    const Ended ended = edit("-w -i " + in + arguments);
    EXPECT_EQ(ended.status, 2) << arguments;
    EXPECT_THAT(ended.output, HasSubstr("is also read by this command")) << arguments;
    EXPECT_TRUE(contentOf(in) == before) << arguments;
  }
}

TEST_F(Edit, anExportReplacesAllCloudsOfAnEarlierOne)
{
  const std::string folder_of_clouds = " --export pcd=" + (folder / "clouds").string();
  ASSERT_EQ(edit("-i " + in + folder_of_clouds).status, 0);
  std::ofstream(folder / "clouds/lidar/mine.txt") << "mine";
  ASSERT_EQ(edit("-w -i " + in + " --to-index 6" + folder_of_clouds).status, 0);

  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "clouds/lidar"))
    names.push_back(entry.path().filename().string());
  EXPECT_THAT(names, testing::UnorderedElementsAre("000000.pcd", "times.txt", "mine.txt"));
  EXPECT_EQ(contentOf(folder / "clouds/lidar/times.txt"), "1700000000.000000000\n");
}

TEST_F(Edit, anInputThatIsMissingIsStatus1)
{
  EXPECT_EQ(edit("-i nowhere.rawlog -o " + out + " --keep-every 2").status, 1);
}

TEST_F(Edit, aCaptureIsStatus2WithTheVerbThatMakesARawlogOfIt)
{
  std::ofstream(folder / "drive.pcap") << "\xd4\xc3\xb2\xa1 and packets";
  const Ended run = edit("-i " + (folder / "drive.pcap").string() + " -o " + out + " --keep-every 2");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, testing::HasSubstr("'scanloom record' makes one of it"));
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(Edit, exportsIntoAFolderThatIsEmptyOrOverwritten)
{
  const std::string folder_of_clouds = " --export pcd=" + (folder / "clouds").string();
  ASSERT_EQ(edit("-i " + in + folder_of_clouds).status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "clouds/lidar/000003.pcd"));
  EXPECT_EQ(edit("-i " + in + folder_of_clouds).status, 2);
  EXPECT_EQ(edit("-i " + in + folder_of_clouds + " -w").status, 0);
  EXPECT_EQ(edit(files + folder_of_clouds + " -w").status, 2) << "-o is not for exports";
}

TEST_F(Edit, aRemovedOptionNamesWhatDoesItNow)
{
  EXPECT_THAT(edit("-i " + in + " --info").output, HasSubstr("it was removed; instead: scanloom info FILE"));
  EXPECT_THAT(edit("-i " + in + " --export-ply clouds").output, HasSubstr("instead: --export ply=DIR"));
  EXPECT_EQ(edit("-i " + in + " --to-octomap=m.bt").status, 2);
  EXPECT_THAT(edit("-i " + in + " --to-octomap=m.bt").output, HasSubstr("instead: scanloom map"));
}

TEST_F(Edit, noticesGoToStandardError)
{
  EXPECT_THAT(edit(files + "--deskew imu", "2>&1 >/dev/null").output, HasSubstr("warning: 'imu' is never at rest"));
}

TEST_F(Edit, aTrajectoryThatCoversNoScanIsAnErrorThatNamesBothTimes)
{
  std::ofstream(folder / "other.tum") << "1600000000 0 0 0 0 0 0 1\n1600000100 2.5 0 0 0 0 0 1\n";
  const Ended ended = edit(files + "--deskew " + (folder / "other.tum").string());
  EXPECT_EQ(ended.status, 1);
  EXPECT_THAT(ended.output, HasSubstr("none of 4 clouds (1700000000.0"));
  EXPECT_THAT(ended.output, HasSubstr("the trajectory (1600000000.000000000 s to 1600000100.000000000 s)"));
  EXPECT_FALSE(std::filesystem::exists(out));
}
}  // namespace
}  // namespace scanloom::edit_unittest
