/** Every INI file of params/rawlog-grabber runs as it is: in our loader and in the stock grabber. */
#include "input/rig/RigOptions.h"
#include "mrpt/observations/RawlogInfo.h"
#include "stockTool.h"
#include "support/ChildProcess.h"
#include "support/TestData.h"
#include "support/runProgram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <thread>

namespace scanloom::rawlog_grabber_params_unittest
{
namespace
{
namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const fs::path kParams = fs::path(SCANLOOM_SOURCE_DIR) / "params";

fs::path rawlogIn(const fs::path& folder)
{
  for (const auto& file : fs::directory_iterator(folder))
    if (file.path().extension() == ".rawlog") return file.path();
  return {};
}

struct LiveParams
{
  const char* file;
  std::size_t lidars;
};

class GrabberLiveParams : public testing::TestWithParam<LiveParams>
{
 protected:
  TemporaryFolder folder;
  fs::path ini = folder / GetParam().file;

  /** The file, and a sensor's metadata under every name that the files know, each with a serial number of its own. */
  void copyInto(const fs::path& recording) const
  {
    fs::copy(kParams / "rawlog-grabber" / GetParam().file, ini);
    nlohmann::json metadata = nlohmann::json::parse(contentOf(recording / "left.json"));
    int serial_number = 1000;
    for (const char* name : {"top", "left", "right", "front_left", "front_right", "rear_left", "rear_right"})
    {
      metadata.at("prod_sn") = std::to_string(++serial_number);
      std::ofstream(folder / (std::string(name) + ".json")) << metadata;
    }
  }
  std::string inFolder(const std::string& command) const { return "env -C " + folder.path().string() + " " + command; }
};
INSTANTIATE_TEST_SUITE_P(Files, GrabberLiveParams,
                         testing::Values(LiveParams{"single.ini", 1}, LiveParams{"dual.ini", 2},
                                         LiveParams{"quad.ini", 4}),
                         [](const auto& each) { return fs::path(each.param.file).stem().string(); });

TEST_P(GrabberLiveParams, runSlamTogetherWithTheHarvestersValues)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  copyInto(recording);
  const Ended ended = runProgram(
      inFolder(fmt::format(SCANLOOM_BIN_DIR "/scanloom slam -c {} -c {}/harvester.ini --out-dir out --dry-run",
                           ini.string(), kParams.string())) +
      " 2>&1");
  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("[slam]"));
  const Configuration configuration = Configuration::fromFiles({ini, kParams / "harvester.ini"});
  EXPECT_EQ(readRigSettings(configuration, rigSection(configuration)).lidars.size(), GetParam().lidars);
}

TEST_P(GrabberLiveParams, runInTheStockGrabberUntilItIsInterrupted)
{
  SCANLOOM_NEEDS_PROGRAM("rawlog-grabber");
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  copyInto(recording);
  const OpenInput input(folder / "input");
  ChildProcess grabber(
      inFolder(fmt::format("rawlog-grabber -p {} {} < {}", SCANLOOM_PLUGIN, ini.string(), input.path().string())),
      folder / "log.txt");
  for (int i = 0; i < 200 && rawlogIn(folder.path()).empty(); ++i) std::this_thread::sleep_for(50ms);
  std::this_thread::sleep_for(1s);  // the file is there before the sensor listens
  grabber.send(SIGINT);
  EXPECT_EQ(grabber.wait(), 0);

  EXPECT_THAT(grabber.log(), HasSubstr("drained (not an error)"));
  EXPECT_THAT(grabber.log(), Not(HasSubstr("unknown key")));
  const RawlogInfo info = rawlogInfo(rawlogIn(folder.path()));
  ASSERT_TRUE(info.header) << "the first object, also where no lidar sent anything";
  EXPECT_EQ(info.header->lidars.size(), GetParam().lidars);
}

TEST(GrabberParams, fourLidarsOfACaptureAreOneCloud)
{
  SCANLOOM_NEEDS_PROGRAM("rawlog-grabber");
  const TemporaryFolder folder;
  std::string names;
  int number = 1;
  for (const char* name : {"front_left", "front_right", "rear_left", "rear_right"})
  {
    const std::string lidar = fmt::format(" --set simulated_lidars.lidar{}_", number);
    names +=
        fmt::format("{0}name={1}{0}model=OS0-8{0}pose='0 0 {2} {3} 10 0'", lidar, name, 2 + 0.1 * number, 90 * number);
    ++number;
  }
  const std::string recording = (folder / "recording").string();
  const Ended simulated = runProgram(
      SCANLOOM_BIN_DIR "/scanloom simulate -c " + (kParams / "simulation/demo.ini").string() +
      " --set simulated_drive.duration=3 --set simulated_drive.standstill=0.5 --set simulated_drive.speed_up=0.5" +
      names + " --out-dir " + recording + " 2>&1");
  ASSERT_EQ(simulated.status, 0) << simulated.output;

  const OpenInput input(folder / "input");
  const std::string log = outputOf(fmt::format(
      "cd {} && SCANLOOM_RECORDING={} timeout 100 rawlog-grabber -p {} {} < {}", folder.path().string(), recording,
      SCANLOOM_PLUGIN, (kParams / "rawlog-grabber/quad_pcap.ini").string(), input.path().string()));
  EXPECT_THAT(log, HasSubstr("drained (not an error)"));
  const fs::path rawlog = rawlogIn(folder.path());
  ASSERT_FALSE(rawlog.empty()) << log;
  const RawlogInfo info = rawlogInfo(rawlog);
  ASSERT_TRUE(info.header);
  ASSERT_EQ(info.header->lidars.size(), 4u);
  EXPECT_EQ(info.header->lidars[3].name, "rear_right");
  EXPECT_GE(occurrences(rawlogEdit("--info -i " + rawlog.string()), "lidar"), 28);
}
}  // namespace
}  // namespace scanloom::rawlog_grabber_params_unittest
