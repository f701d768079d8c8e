/** `scanloom simulate` into a folder, as a person meets it. */
#include "mrpt/observations/RawlogInput.h"
#include "support/ChildProcess.h"
#include "support/TemporaryFolder.h"
#include "support/runProgram.h"

#include <gmock/gmock.h>
#include <unistd.h>

namespace scanloom::simulate_unittest
{
namespace
{
using testing::HasSubstr;

struct Simulate : testing::Test
{
  TemporaryFolder folder;
  const std::filesystem::path out = folder / "out";

  static std::string command(const std::string& arguments)
  {
    return SCANLOOM_BIN_DIR
           "/scanloom simulate --set simulated_lidars.lidar1_model=OS0-8 --set simulated_drive.standstill=0.1 --set "
           "simulated_drive.speed_up=0.3 " +
           arguments;
  }
  Ended simulate(const std::string& arguments) const
  {
    return runProgram(command("--out-dir " + out.string() + " " + arguments) + " 2>&1");
  }
};

TEST_F(Simulate, whatIsNoLengthIsStatus2)
{
  for (const char* length : {"nan", "inf", "-1", "0"})
    EXPECT_EQ(simulate(std::string("--set simulated_drive.duration=") + length).status, 2) << length;
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(Simulate, namesOfLidarsAreNoWayOutOfTheFolder)
{
  for (const std::string& name : {std::string("../../evil"), (folder / "evil").string(), std::string("..")})
  {
    const Ended ended = simulate("--set simulated_drive.duration=1 --set simulated_lidars.lidar1_name=" + name);
    EXPECT_EQ(ended.status, 2) << name;
    EXPECT_THAT(ended.output, HasSubstr("[simulated_lidars] lidar1_name"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_F(Simulate, aRecordingIsReplacedAsAWholeOrNotAtAll)
{
  std::filesystem::create_directory(out);
  for (const char* name : {"recording.pcap", "groundtruth.tum", "left.json"}) std::ofstream(out / name) << "earlier";
  ChildProcess child(command("-w --set simulated_drive.duration=600 --out-dir " + out.string()), folder / "log.txt");
  const auto files = [&] { return std::distance(std::filesystem::directory_iterator(out), {}); };
  for (int i = 0; i < 1000 && files() < 4; ++i) usleep(10'000);  // until it is running
  usleep(100'000);
  child.send(SIGTERM);
  EXPECT_EQ(child.wait(), 130) << child.log();
  for (const char* name : {"recording.pcap", "groundtruth.tum", "left.json"})
    EXPECT_EQ(contentOf(out / name), "earlier") << name;
  EXPECT_EQ(files(), 3);

  ASSERT_EQ(simulate("-w --set simulated_drive.duration=1").status, 0);
  for (const char* name : {"recording.pcap", "groundtruth.tum", "left.json"})
    EXPECT_NE(contentOf(out / name), "earlier") << name;
}

TEST_F(Simulate, theMetadataThatItReadsAreNotReplaced)
{
  ASSERT_EQ(simulate("--set simulated_drive.duration=1").status, 0);
  const std::string before = contentOf(out / "left.json");
  const std::string metadata = " --set simulated_lidars.lidar1_metadata=" + (out / "left.json").string();
  const Ended ended = simulate("-w --set simulated_drive.duration=1" + metadata);
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.output, HasSubstr("is also read by this command"));
  EXPECT_EQ(contentOf(out / "left.json"), before);
}

TEST_F(Simulate, wholeTurnsAreARawlogThatIsReadAsAnyOther)
{
  ASSERT_EQ(simulate("--set simulated_drive.duration=1 --set simulated_recording.whole_turns=nearest").status, 0);
  EXPECT_FALSE(std::filesystem::exists(out / "recording.pcap"));

  RawlogInput input(out / "recording.rawlog");
  std::vector<Duration> periods;
  std::size_t samples = 0;
  while (const auto event = input.next())
    if (const auto* scan = std::get_if<Scan>(&*event))
      periods.push_back(scan->period);
    else
      ++samples;
  ASSERT_GE(periods.size(), 7u);
  for (std::size_t i = 1; i + 1 < periods.size(); ++i) EXPECT_GT(periods[i], 95ms) << "scan " << i;
  EXPECT_GT(samples, 200u);  // the body's 200 Hz, and those of the lidars

  EXPECT_EQ(simulate("-w --set simulated_drive.duration=1 --set simulated_recording.whole_turns=farthest").status, 2);
}
}  // namespace
}  // namespace scanloom::simulate_unittest
