/** `scanloom simulate --udp` and verbs that know of its lidars the addresses only. */
#include "base/formats/Trajectory.h"
#include "mrpt/observations/RawlogReader.h"
#include "support/ChildProcess.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/UdpSender.h"

#include <gmock/gmock.h>

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <thread>

namespace scanloom::simulate_udp_unittest
{
namespace
{
using testing::HasSubstr;

/** What a child printed so far, up to the end of its section. */
std::string sectionPrintedBy(const ChildProcess& child)
{
  for (int i = 0; i < 1000; ++i)
  {
    const std::string log = child.log();
    if (log.find("lidar2_pose") != std::string::npos && log.back() == '\n') return log.substr(log.find("[lidars]"));
    std::this_thread::sleep_for(10ms);
  }
  return "";
}

/** Two lidars of 16 beams with web pages, in a stand of so many stems per hectare. */
struct SimulatedSensors
{
  SimulatedSensors(const TemporaryFolder& folder, int seconds, int stems)
    : simulate(started(folder, seconds, stems), folder / "simulate.txt"), section(sectionPrintedBy(simulate))
  {
  }

  ChildProcess simulate;
  std::string section;  // of an INI file that reads them

 private:
  static std::string started(const TemporaryFolder& folder, int seconds, int stems)
  {
    const std::uint16_t left = freeUdpPort(), right = freeUdpPort();
    std::ofstream(folder / "scene.ini") << fmt::format(
        "[simulated_drive]\nduration = {}\nroute = work\nspeed_up = 1\n[simulated_stand]\nstems_per_hectare = {}\n"
        "[simulated_lidars]\nlidar1_name = left\nlidar1_model = OS0-16\nlidar1_port = {}\nlidar2_name = right\n"
        "lidar2_port = {}\n",
        seconds, stems, left, right);
    return fmt::format("{}/scanloom simulate -c {} --udp", SCANLOOM_BIN_DIR, (folder / "scene.ini").string());
  }
};
}  // namespace

TEST(SimulateUdp, isRecordedByAddressesAlone)
{
  const TemporaryFolder folder;
  SimulatedSensors sensors(folder, 4, 0);
  ASSERT_THAT(sensors.section, HasSubstr("lidar1_address = 127.0.0.2:"));
  std::ofstream(folder / "live.ini") << sensors.section << "deadline_ms = 200\n";
  ChildProcess record(fmt::format("{}/scanloom record -c {} -o {}", SCANLOOM_BIN_DIR, (folder / "live.ini").string(),
                                  (folder / "live.rawlog").string()),
                      folder / "record.txt");

  EXPECT_EQ(sensors.simulate.wait(), 0) << sensors.simulate.log();
  std::this_thread::sleep_for(300ms);
  record.send(SIGINT);
  EXPECT_EQ(record.wait(), 130) << record.log();

  std::array<std::size_t, 2> columns{};
  RawlogReader reader(folder / "live.rawlog");
  while (auto event = reader.next())
    if (const auto* recorded = std::get_if<RecordedScan>(&*event))
      for (std::size_t i : {0, 1}) columns[i] += recorded->scan.columns_of[i];
  for (const std::size_t received : columns)
    EXPECT_GE(received, 37u * 512) << "4 s of 10 turns, less what was before the start: " << record.log();
  EXPECT_THAT(sensors.simulate.log(), HasSubstr(" 0 could not be sent"));
}

TEST(SimulateUdp, isLocalisedInLive)
{
  const TemporaryFolder folder;
  SimulatedSensors sensors(folder, 8, 600);
  std::ofstream(folder / "live.ini") << sensors.section << "deadline_ms = 200\n[slam]\nimu = left\n";
  ChildProcess slam(fmt::format("{}/scanloom slam -c {} --out-dir {}", SCANLOOM_BIN_DIR, (folder / "live.ini").string(),
                                (folder / "out").string()),
                    folder / "slam.txt");

  EXPECT_EQ(sensors.simulate.wait(), 0) << sensors.simulate.log();
  std::this_thread::sleep_for(500ms);
  slam.send(SIGINT);
  EXPECT_EQ(slam.wait(), 130) << slam.log();
  const Trajectory poses = readTum(folder / "out" / "trajectory.tum");
  EXPECT_GE(poses.size(), 60u) << "8 s of 10 scans, some of them before the start: " << slam.log();
  EXPECT_GT(readTum(folder / "out" / "trajectory_imu.tum").size(), 2 * poses.size());
}

TEST(SimulateUdp, isEitherForAFolderOrForRealTime)
{
  const TemporaryFolder folder;
  ChildProcess neither(fmt::format("{}/scanloom simulate", SCANLOOM_BIN_DIR), folder / "log.txt");
  EXPECT_EQ(neither.wait(), 2);
  EXPECT_THAT(neither.log(), HasSubstr("--out-dir"));
}
}  // namespace scanloom::simulate_udp_unittest
