/** `scanloom record` of captures, as a person meets it. */
#include "mrpt/observations/RawlogInfo.h"
#include "support/ChildProcess.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/runProgram.h"

#include <gmock/gmock.h>
#include <unistd.h>

namespace scanloom::record_unittest
{
namespace
{
using testing::HasSubstr;

std::string recordCommand(const std::filesystem::path& recording, const std::string& arguments)
{
  return "SCANLOOM_RECORDING=" + recording.string() +
         " " SCANLOOM_BIN_DIR "/scanloom record -c " SCANLOOM_SOURCE_DIR "/params/dual_os0_recording.ini " + arguments;
}

TEST(RecordVerb, anOutputIsNeverAnInput)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder copy;
  for (const auto& entry : std::filesystem::directory_iterator(recording))
    std::filesystem::copy_file(entry.path(), copy / entry.path().filename());
  for (const char* name : {"recording.pcap", "imu.csv", "extrinsics.txt", "left.json"})
  {
    const std::string before = contentOf(copy / name);
    const Ended ended = runProgram(recordCommand(copy.path(), "-w -o " + (copy / name).string()) + " 2>&1");
    EXPECT_EQ(ended.status, 2) << ended.output;
    EXPECT_THAT(ended.output, HasSubstr("is also read by this command"));
    EXPECT_TRUE(contentOf(copy / name) == before) << name;
  }
}

TEST(RecordVerb, anInterruptedRecordingOfCapturesReplacesNoWholeOne)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder folder;
  std::ofstream(folder / "a.rawlog") << "earlier";
  ChildProcess child("env " + recordCommand(recording, "-w -o " + (folder / "a.rawlog").string()), folder / "log.txt");
  const auto part = folder / "a.rawlog.part";
  for (int i = 0; i < 600 && !(std::filesystem::exists(part) && std::filesystem::file_size(part) > 0); ++i)
    usleep(10'000);
  child.send(SIGTERM);
  EXPECT_EQ(child.wait(), 130) << child.log();
  EXPECT_THAT(child.log(), HasSubstr("ending; once more ends it at once"));
  EXPECT_EQ(contentOf(folder / "a.rawlog"), "earlier");
  EXPECT_GT(rawlogInfo(folder / "a.partial.rawlog").observations(), 1u);
  EXPECT_THAT(child.log(), HasSubstr("a.partial.rawlog"));
  EXPECT_FALSE(std::filesystem::exists(part));
}
}  // namespace
}  // namespace scanloom::record_unittest
