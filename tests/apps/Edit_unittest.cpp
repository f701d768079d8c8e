/** `scanloom edit` as a person meets it. */
#include "dataset/smallRawlog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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
  EXPECT_EQ(uncompressed(merged), uncompressed(in));
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
}  // namespace
}  // namespace scanloom
