/** `scanloom slam` as a person meets it when something is wrong. */
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <string>

#include "base/formats/Trajectory.h"
#include "support/ChildProcess.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/runProgram.h"

namespace scanloom::slam_unittest
{
namespace
{
Ended slam(const std::filesystem::path& recording, const std::string& arguments)
{
  const std::string command = "SCANLOOM_RECORDING=" + recording.string() + "/" +  // as a shell completes it
                              " " SCANLOOM_BIN_DIR "/scanloom slam -c " SCANLOOM_SOURCE_DIR
                              "/params/dual_os0_recording.ini " +
                              arguments + " 2>&1 </dev/null";
  return runProgram(command);
}

/** The first records of a recording, some seconds of it, and a damaged one behind them. */
std::filesystem::path damagedCopy(const std::filesystem::path& recording, const std::filesystem::path& folder)
{
  constexpr std::size_t kPart = 4'500'000, kFileHeader = 24, kRecordHeader = 16, kLengthAt = 8;
  for (const auto& entry : std::filesystem::directory_iterator(recording))
    if (entry.path().extension() != ".pcap") std::filesystem::copy_file(entry.path(), folder / entry.path().filename());
  const std::string whole = contentOf(recording / "recording.pcap");
  std::size_t end = kFileHeader;
  while (end < kPart)
  {
    std::uint32_t length = 0;
    std::memcpy(&length, whole.data() + end + kLengthAt, sizeof length);
    end += kRecordHeader + length;
  }
  std::ofstream(folder / "recording.pcap", std::ios::binary)
      << whole.substr(0, end) << std::string(kRecordHeader, '\xff') << whole.substr(end + kRecordHeader, 1'000'000);
  return folder;
}

nlohmann::json summaryIn(const std::filesystem::path& folder)
{
  return nlohmann::json::parse(contentOf(folder / "summary.json"));
}
}  // namespace

TEST(SlamVerb, aDamageOfTheCaptureEndsTheReadingButNotTheRun)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder copy, folder;
  const Ended ended =
      slam(damagedCopy(recording, copy.path()), "--set output.maps=false --out-dir " + folder.path().string());
  EXPECT_EQ(ended.status, 3) << ended.output;
  EXPECT_NE(ended.output.find("recording.pcap: damaged after record "), std::string::npos) << ended.output;
  const nlohmann::json summary = summaryIn(folder.path());
  EXPECT_EQ(summary["counts"]["damaged_files"], 1);
  EXPECT_EQ(summary["outcome"], "OK");
  EXPECT_GT(readTum(folder / "trajectory.tum").size(), 20u);
}

TEST(SlamVerb, aLidarAtAnotherPortIsMissingAndThePortIsNamed)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder copy, folder;
  const Ended ended = slam(damagedCopy(recording, copy.path()),
                           "--set output.maps=false --set lidars.lidar2_port=9999 --out-dir " + folder.path().string());
  EXPECT_EQ(ended.status, 3) << ended.output;
  EXPECT_NE(ended.output.find("lidar 'right': its packets come to port 7504, not to 9999: set lidar2_port = 7504"),
            std::string::npos)
      << ended.output;
  EXPECT_EQ(summaryIn(folder.path())["outcome"], "LIDAR MISSING");
}

TEST(SlamVerb, aFailedRunLeavesTheResultsOfAnEarlierOneWhole)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder folder;
  for (const char* name : {"trajectory.tum", "summary.json", "map.ply"}) std::ofstream(folder / name) << "earlier";
  const Ended ended = runProgram("trap '' XFSZ; ulimit -f 500; SCANLOOM_RECORDING=" + recording.string() +
                                 " timeout 300 " SCANLOOM_BIN_DIR "/scanloom slam -c " SCANLOOM_SOURCE_DIR
                                 "/params/dual_os0_recording.ini -w --set local_map.keyframe_distance=0.5 --out-dir " +
                                 folder.path().string() + " 2>&1");
  ASSERT_EQ(ended.status, 1) << ended.output;
  EXPECT_NE(ended.output.find("File too large"), std::string::npos) << ended.output;
  for (const char* name : {"trajectory.tum", "summary.json", "map.ply"})
    EXPECT_EQ(contentOf(folder / name), "earlier") << name;
  EXPECT_GT(readTum(folder / "partial" / "trajectory.tum").size(), 20u);
  EXPECT_NE(summaryIn(folder / "partial")["error"].get<std::string>().find("File too large"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "partial" / "map.ply"));
}

TEST(SlamVerb, anInterruptedRunIsPutBesideTheResultsOfAnEarlierOne)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder folder;
  for (const char* name : {"trajectory.tum", "summary.json"}) std::ofstream(folder / name) << "earlier";
  constexpr std::uintmax_t kSomeScans = 20'000;  // bytes of trajectory_imu.tum
  const auto running = [&]
  {
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      if (entry.is_directory())
        for (const auto& file : std::filesystem::directory_iterator(entry.path()))
          if (file.path().extension() == ".tum" && std::filesystem::file_size(file.path()) > kSomeScans) return true;
    return false;
  };
  ChildProcess child("env SCANLOOM_RECORDING=" + recording.string() +
                         " " SCANLOOM_BIN_DIR "/scanloom slam -c " SCANLOOM_SOURCE_DIR
                         "/params/dual_os0_recording.ini -w --out-dir " +
                         folder.path().string(),
                     folder / "log.txt");
  for (int i = 0; i < 600 && !running(); ++i) usleep(50'000);
  child.send(SIGTERM);
  EXPECT_EQ(child.wait(), 130) << child.log();
  EXPECT_EQ(contentOf(folder / "trajectory.tum"), "earlier");
  EXPECT_EQ(contentOf(folder / "summary.json"), "earlier");
  EXPECT_EQ(summaryIn(folder / "partial")["outcome"], "INTERRUPTED");
  EXPECT_GT(readTum(folder / "partial" / "trajectory.tum").size(), 1u);
}

TEST(SlamVerb, whatIsNoSensibleBoundIsWrongUsage)
{
  const TemporaryFolder folder;
  for (const std::string setting : {"crop.min_x=20", "crop.max_range=0.1", "map_cells.cell_size=1e-9",
                                    "map_cells.cell_size=nan", "crop.max_range=1e300", "slam.imu_delay_ms=1e12"})
  {
    const Ended ended = slam(folder.path(), "--dry-run --set " + setting + " --out-dir " + (folder / "out").string());
    EXPECT_EQ(ended.status, 2) << setting;
    EXPECT_NE(ended.output.find("must be "), std::string::npos) << ended.output;
  }
}

TEST(SlamVerb, aLidarThatIsNotThereIsWrongUsageAndNamesTheNearest)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder folder;
  const Ended ended = slam(recording, "--lidars lefft --out-dir " + folder.path().string());
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.output.find("did you mean 'left'?"), std::string::npos) << ended.output;
}

TEST(SlamVerb, aMissingRecordingFails)
{
  const TemporaryFolder folder;
  EXPECT_NE(slam(folder.path(), "--out-dir " + folder.path().string()).status, 0);
}

TEST(SlamVerb, resultsThatExistAreNotOverwrittenUnasked)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder folder;
  std::ofstream(folder / "trajectory.tum") << "precious\n";
  EXPECT_EQ(slam(recording, "--out-dir " + folder.path().string()).status, 2);
  EXPECT_EQ(contentOf(folder / "trajectory.tum"), "precious\n");
}

TEST(SlamVerb, aDryRunPrintsWhatIsInEffectAndWritesNothing)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder folder;
  const Ended ended = slam(recording, "--dry-run --every-nth 7 --out-dir " + (folder / "out").string());
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.output.find("every_nth = 7"), std::string::npos) << ended.output;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}
}  // namespace scanloom::slam_unittest
