/** The plugin in the stock rawlog-grabber, with the INI files of params/; the batcher alone is the reference. */
#include "input/rig/internal/RigReplay.h"
#include "mrpt/observations/RawlogInfo.h"
#include "mrpt/observations/RawlogReader.h"
#include "stockTool.h"
#include "support/TestData.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace scanloom::rawlog_grabber_unittest
{
namespace
{
namespace fs = std::filesystem;

const fs::path kParams = fs::path(SCANLOOM_SOURCE_DIR) / "params/rawlog-grabber";
constexpr const char* kCapture = "ouster/ouster-lidar+ouster-sdk/tests/pcaps/OS-1-128_v2.3.0_1024x10_lb_n3.pcap";
constexpr const char* kMetadata = "ouster/ouster-lidar+ouster-sdk/tests/pcaps/OS-1-128_v2.3.0_1024x10.json";

/** A recording's folder with the first bytes of its capture alone: some seconds instead of 30. */
fs::path beginningOf(const fs::path& recording, const fs::path& folder)
{
  constexpr std::uintmax_t kBytes = 6'000'000;
  fs::create_directories(folder);
  for (const char* name : {"left.json", "right.json", "extrinsics.txt", "imu.csv", "recording.pcap"})
  {
    fs::copy_file(recording / name, folder / name);
    fs::permissions(folder / name, fs::perms::owner_write, fs::perm_options::add);
  }
  fs::resize_file(folder / "recording.pcap", kBytes);
  return folder;
}

struct Grabbed
{
  fs::path rawlog;  // empty if there is none
  std::string log;
};

/** Runs in the workplace; the grabber names its file after the date. */
Grabbed grab(const TemporaryFolder& workplace, const fs::path& ini)
{
  const OpenInput input(workplace / "input");
  Grabbed grabbed;
  grabbed.log = outputOf(fmt::format("cd {} && timeout 300 rawlog-grabber -p {} {} < {}", workplace.path().string(),
                                     SCANLOOM_PLUGIN, ini.string(), input.path().string()));
  for (const auto& file : fs::directory_iterator(workplace.path()))
    if (file.path().extension() == ".rawlog") grabbed.rawlog = file.path();
  return grabbed;
}

std::vector<SensorEvent> replayed(const fs::path& ini)
{
  const Configuration configuration = Configuration::fromFiles({ini});
  RigReplay replay(makeRig(readRigSettings(configuration, rigSection(configuration))));
  std::vector<SensorEvent> events;
  while (auto event = replay.next()) events.push_back(*std::move(event));
  return events;
}

std::vector<Scan> scansOf(const std::vector<SensorEvent>& events)
{
  std::vector<Scan> scans;
  for (const auto& event : events)
    if (const auto* scan = std::get_if<Scan>(&event)) scans.push_back(*scan);
  return scans;
}

std::vector<Scan> scansOf(const fs::path& rawlog)
{
  std::vector<Scan> scans;
  RawlogReader reader(rawlog);
  while (const auto event = reader.next())
    if (const auto* recorded = std::get_if<RecordedScan>(&*event)) scans.push_back(recorded->scan);
  EXPECT_EQ(reader.damage(), "");
  return scans;
}

void expectTheSame(const std::vector<Scan>& grabbed, const std::vector<Scan>& reference)
{
  ASSERT_EQ(grabbed.size(), reference.size());
  for (std::size_t i = 0; i < grabbed.size(); i++)
  {
    EXPECT_EQ(grabbed[i].start, reference[i].start);
    EXPECT_EQ(grabbed[i].points.x, reference[i].points.x);
    EXPECT_EQ(grabbed[i].points.z, reference[i].points.z);
    EXPECT_EQ(grabbed[i].points.sensor_id, reference[i].points.sensor_id);
    EXPECT_EQ(grabbed[i].points.column, reference[i].points.column);
  }
}
}  // namespace

TEST(RawlogGrabber, writesEveryScanOfTwoLidars)
{
  SCANLOOM_NEEDS_PROGRAM("rawlog-grabber");
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder workplace;
  setenv("SCANLOOM_RECORDING", beginningOf(recording, workplace / "recording").c_str(), 1);
  const fs::path ini = kParams / "dual_pcap.ini";

  const Grabbed grabbed = grab(workplace, ini);

  ASSERT_FALSE(grabbed.rawlog.empty()) << grabbed.log;
  EXPECT_NE(grabbed.log.find("end of input: drained (not an error)"), std::string::npos) << grabbed.log;
  const auto events = replayed(ini);
  const auto reference = scansOf(events);
  ASSERT_GT(reference.size(), 20u);
  expectTheSame(scansOf(grabbed.rawlog), reference);

  const RawlogInfo info = rawlogInfo(grabbed.rawlog);
  EXPECT_EQ(info.observations(), events.size()) << "scans and IMU samples, and nothing else";
  ASSERT_TRUE(info.header);
  EXPECT_EQ(info.header->lidars.at(1).name, "right");

  const std::string stock_info = rawlogEdit("--info -i " + grabbed.rawlog.string());
  EXPECT_EQ(occurrences(stock_info, "lidar"), static_cast<int>(reference.size())) << stock_info;
}

TEST(RawlogGrabber, writesEveryScanAndImuSampleOfARealCapture)
{
  SCANLOOM_NEEDS_PROGRAM("rawlog-grabber");
  SCANLOOM_NEEDS_DATA(capture, kCapture);
  SCANLOOM_NEEDS_DATA(metadata, kMetadata);
  const TemporaryFolder workplace;
  setenv("SCANLOOM_PCAP", fs::absolute(capture).c_str(), 1);
  setenv("SCANLOOM_METADATA", fs::absolute(metadata).c_str(), 1);
  const fs::path ini = kParams / "single_pcap.ini";

  const Grabbed grabbed = grab(workplace, ini);

  ASSERT_FALSE(grabbed.rawlog.empty()) << grabbed.log;
  const auto reference = scansOf(replayed(ini));
  ASSERT_GE(reference.size(), 3u);
  expectTheSame(scansOf(grabbed.rawlog), reference);
  const std::string stock_info = rawlogEdit("--info -i " + grabbed.rawlog.string());
  EXPECT_EQ(occurrences(stock_info, "lidar"), static_cast<int>(reference.size())) << stock_info;
  EXPECT_EQ(occurrences(stock_info, "imu_top"), 30) << stock_info;
}

TEST(RawlogGrabber, printsWhichKeyIsWrong)
{
  SCANLOOM_NEEDS_PROGRAM("rawlog-grabber");
  const TemporaryFolder workplace;
  std::ofstream(workplace / "wrong.ini")
      << "[global]\nGRABBER_PERIOD_MS = 50\n[lidars]\ndriver = CMultiLidarSensor\n"
         "process_rate = 100\nlidar1_metadata = a.json\nlidar1_poes = [0 0 0 0 0 0]\n";

  const std::string log = grab(workplace, workplace / "wrong.ini").log;

  EXPECT_NE(log.find("lidar1_poes is an unknown key: did you mean 'lidar1_pose'?"), std::string::npos) << log;
}
}  // namespace scanloom::rawlog_grabber_unittest
