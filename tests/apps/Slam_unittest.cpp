/** `scanloom slam` as a person meets it when something is wrong. */
#include <gtest/gtest.h>

#include <string>

#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/runProgram.h"

using namespace scanloom;

namespace
{
Ended slam(const std::filesystem::path& recording, const std::string& arguments)
{
  const std::string command = "SCANLOOM_RECORDING=" + recording.string() +
                              " " SCANLOOM_BIN_DIR "/scanloom slam -c " SCANLOOM_SOURCE_DIR
                              "/params/dual_os0_recording.ini " +
                              arguments + " 2>&1 </dev/null";
  return runProgram(command);
}
}  // namespace

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
