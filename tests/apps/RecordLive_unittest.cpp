/** `scanloom record` on lidars of the loopback interface: how it ends, and what is on disk when it does. */
#include "input/packets/CaptureReader.h"
#include "input/rig/internal/RigReplay.h"
#include "mrpt/observations/RawlogReader.h"
#include "support/ChildProcess.h"
#include "support/RecordedLidars.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/runProgram.h"
#include "support/stockTool.h"

#include <gmock/gmock.h>

#include <fmt/format.h>
#include <regex>

namespace scanloom::record_live_unittest
{
namespace
{
using testing::HasSubstr;

constexpr std::size_t kDatagrams = 2500;  // 3.2 s of the recording

/** The recorder with its files in a folder of its own. */
struct Recorder
{
  explicit Recorder(const RecordedLidars& lidars, const std::string& arguments = "")
  {
    std::ofstream(folder / "live.ini") << lidars.section() << "pcap_output = " << capture.string() << '\n';
    command = fmt::format("{}/scanloom record -c {} -o {} {}", SCANLOOM_BIN_DIR, (folder / "live.ini").string(),
                          rawlog.string(), arguments);
    child.emplace(command, folder / "log.txt");
    lidars.waitForReceiver();
  }

  TemporaryFolder folder;
  std::filesystem::path rawlog = folder / "live.rawlog";
  std::filesystem::path part = folder / "live.rawlog.part";
  std::filesystem::path capture = folder / "live.pcap";
  std::string command;
  std::optional<ChildProcess> child;
};

std::vector<Scan> scansOf(const std::filesystem::path& rawlog)
{
  std::vector<Scan> scans;
  RawlogReader reader(rawlog);
  while (auto event = reader.next())
    if (auto* recorded = std::get_if<RecordedScan>(&*event)) scans.push_back(std::move(recorded->scan));
  return scans;
}

std::size_t scansInReplayOf(const Recorder& recorder)
{
  const Configuration configuration = Configuration::fromFiles({recorder.folder / "live.ini"});
  Rig rig = makeRig(readRigSettings(configuration, "lidars"));
  rig.captures = {recorder.capture};
  RigReplay replay(rig);
  std::size_t scans = 0;
  while (auto event = replay.next()) scans += std::holds_alternative<Scan>(*event);
  return scans;
}
}  // namespace

using RecordLive = testing::TestWithParam<int>;
INSTANTIATE_TEST_SUITE_P(Signals, RecordLive, testing::Values(SIGINT, SIGTERM));

TEST_P(RecordLive, savesEverythingWhenItIsInterruptedAndSaysSo)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const RecordedLidars lidars(recording, kDatagrams);
  Recorder recorder(lidars);
  lidars.send();
  recorder.child->send(GetParam());  // while the last datagrams are on their way

  EXPECT_EQ(recorder.child->wait(), 130) << recorder.child->log();
  EXPECT_FALSE(std::filesystem::exists(recorder.part));
  const auto scans = scansOf(recorder.rawlog);
  EXPECT_GE(scans.size(), static_cast<std::size_t>(seconds(lidars.length()) * 10) - 2);
  EXPECT_EQ(scans.size(), scansInReplayOf(recorder)) << "as many as the capture gives, the cut last one included";
  EXPECT_THAT(recorder.child->log(), HasSubstr(fmt::format("{} scans and", scans.size())));

  CaptureReader capture(recorder.capture);
  std::size_t datagrams = 0;
  for (Datagram datagram; capture.next(datagram);) ++datagrams;
  EXPECT_EQ(datagrams, kDatagrams);
}

TEST(RecordLive, rawlogAndCaptureAreReadableUpToTheLastSecondAfterKill)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const RecordedLidars lidars(recording, kDatagrams);
  Recorder recorder(lidars);
  lidars.send();
  recorder.child->send(SIGKILL);
  EXPECT_EQ(recorder.child->wait(), 128 + SIGKILL);
  const Timestamp sent_until = lidars.datagrams().back().received;

  EXPECT_FALSE(std::filesystem::exists(recorder.rawlog)) << "it bears that name only when it is whole";
  const auto scans = scansOf(recorder.part);
  ASSERT_FALSE(scans.empty());
  EXPECT_LT(sent_until - scans.back().end(), 1200ms) << "one second, and the scan under way";

  CaptureReader capture(recorder.capture);
  Datagram datagram;
  while (capture.next(datagram)) continue;
  std::size_t last = 0;  // the capture's stamps are of today: find the datagram itself
  for (std::size_t i = 0; i < kDatagrams; ++i)
    if (lidars.datagrams()[i].payload == datagram.payload) last = i;
  EXPECT_LT(sent_until - lidars.datagrams()[last].received, 1100ms);

#ifdef SCANLOOM_SANITIZED
  GTEST_SKIP() << "a stock program cannot load a plugin with a sanitizer";
#endif
  SCANLOOM_NEEDS_TOOL("rawlog-edit");
  const std::string info = fmt::format("rawlog-edit -p {} --info -i {}", SCANLOOM_PLUGIN, recorder.part.string());
  const std::string stock = runProgram(info + " 2>&1").output;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(stock, found, std::regex(": +lidar */ *([0-9]+) "))) << stock;
  EXPECT_GE(std::stoul(found[1]), scans.size() - 1) << "MRPT's own reader goes on from member to member";
}

TEST(RecordLive, whatAKillLeftOutlivesTheSameCommandAgain)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const RecordedLidars lidars(recording, kDatagrams);
  Recorder recorder(lidars);
  lidars.send();
  recorder.child->send(SIGKILL);
  recorder.child->wait();
  const std::string rawlog = contentOf(recorder.part), capture = contentOf(recorder.capture);
  ASSERT_GT(rawlog.size(), 100'000u);

  ChildProcess again(recorder.command + " -w", recorder.folder / "again.txt");
  const auto hasBegun = [&]
  { return std::filesystem::exists(recorder.part) && again.log().find("live.rawlog.part.1") != std::string::npos; };
  for (int i = 0; i < 1000 && !hasBegun(); ++i) usleep(10'000);
  again.send(SIGKILL);
  again.wait();
  EXPECT_TRUE(contentOf(recorder.part.string() + ".1") == rawlog);
  EXPECT_TRUE(contentOf(recorder.folder / "live.replaced.pcap") == capture);
  EXPECT_THAT(again.log(), HasSubstr("live.rawlog.part.1"));
}

TEST(RecordLive, withoutAScanReplacesNothing)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const RecordedLidars lidars(recording, 10);
  Recorder recorder(lidars, "--seconds 0.3");
  EXPECT_EQ(recorder.child->wait(), 1) << "nobody sent";
  std::ofstream(recorder.rawlog) << "good";
  std::ofstream(recorder.capture) << "good capture";

  ChildProcess again(recorder.command + " -w", recorder.folder / "again.txt");
  EXPECT_EQ(again.wait(), 1);
  EXPECT_EQ(contentOf(recorder.rawlog), "good");
  EXPECT_EQ(contentOf(recorder.folder / "live.replaced.pcap"), "good capture");
}

TEST(RecordLive, stopsByItselfAfterTheSecondsThatWereAskedFor)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const RecordedLidars lidars(recording, kDatagrams);
  Recorder recorder(lidars, "--seconds 1.5");
  const auto start = std::chrono::steady_clock::now();
  std::thread sending([&] { lidars.send(); });
  EXPECT_EQ(recorder.child->wait(), 0) << recorder.child->log();
  EXPECT_LT(std::chrono::steady_clock::now() - start, 3s);
  sending.join();

  EXPECT_GE(scansOf(recorder.rawlog).size(), 10u);
}

TEST(RecordLive, namesThePortThatIsTaken)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const RecordedLidars lidars(recording, 10);
  Recorder first(lidars);
  Recorder second(lidars);
  EXPECT_EQ(second.child->wait(), 1);
  EXPECT_THAT(second.child->log(), HasSubstr("another program receives there"));
  first.child->send(SIGINT);
  EXPECT_EQ(first.child->wait(), 130) << first.child->log();
}
}  // namespace scanloom::record_live_unittest
