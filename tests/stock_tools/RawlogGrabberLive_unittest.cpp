/** The plugin in the stock rawlog-grabber with lidars of the loopback interface; its own capture is the reference. */
#include "input/rig/internal/RigReplay.h"
#include "mrpt/observations/RawlogReader.h"
#include "stockTool.h"
#include "support/ChildProcess.h"
#include "support/RecordedLidars.h"
#include "support/TestData.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace scanloom::rawlog_grabber_live_unittest
{
namespace
{
namespace fs = std::filesystem;

fs::path rawlogIn(const fs::path& folder)
{
  for (const auto& file : fs::directory_iterator(folder))
    if (file.path().extension() == ".rawlog") return file.path();
  return {};
}
}  // namespace

TEST(RawlogGrabberLive, writesEveryScanUntilItIsInterrupted)
{
  SCANLOOM_NEEDS_PROGRAM("rawlog-grabber");
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder workplace;
  const RecordedLidars lidars(recording, 3000);
  const fs::path ini = workplace / "live.ini", capture = workplace / "live.pcap";
  std::ofstream(ini) << "[global]\nGRABBER_PERIOD_MS = 200\nrawlog_prefix = live\n"
                     << lidars.section() << "pcap_output = " << capture.string() << '\n';
  const OpenInput input(workplace / "input");

  ChildProcess grabber(fmt::format("env -C {} rawlog-grabber -p {} {} < {}", workplace.path().string(), SCANLOOM_PLUGIN,
                                   ini.string(), input.path().string()),
                       workplace / "log.txt");
  lidars.waitForReceiver();
  lidars.send();
  grabber.send(SIGINT);
  grabber.wait();

  EXPECT_NE(grabber.log().find("end of input: drained (not an error)"), std::string::npos) << grabber.log();
  Rig rig = makeRig(readRigSettings(Configuration::fromFiles({ini}), "lidars"));
  rig.captures = {capture};
  RigReplay replay(rig);
  std::vector<Scan> expected;
  while (auto event = replay.next())
    if (auto* scan = std::get_if<Scan>(&*event)) expected.push_back(std::move(*scan));
  ASSERT_GT(expected.size(), 30u);

  const fs::path rawlog = rawlogIn(workplace.path());
  ASSERT_FALSE(rawlog.empty()) << grabber.log();
  RawlogReader reader(rawlog);
  std::size_t scans = 0;
  for (auto event = reader.next(); event; event = reader.next())
  {
    const auto* recorded = std::get_if<RecordedScan>(&*event);
    if (!recorded) continue;
    ASSERT_LT(scans, expected.size());
    EXPECT_EQ(recorded->scan.start, expected[scans].start);
    EXPECT_EQ(recorded->scan.points.x, expected[scans].points.x);
    EXPECT_EQ(recorded->scan.points.sensor_id, expected[scans].points.sensor_id);
    ++scans;
  }
  EXPECT_EQ(reader.damage(), "");
  EXPECT_EQ(scans, expected.size());
  EXPECT_EQ(occurrences(rawlogEdit("--info -i " + rawlog.string()), "lidar"), static_cast<int>(expected.size()));
}
}  // namespace scanloom::rawlog_grabber_live_unittest
