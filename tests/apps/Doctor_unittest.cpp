/** `scanloom doctor` as a person meets it. */
#include "mrpt/edit/smallRawlog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/runProgram.h"

namespace scanloom::doctor_unittest
{
namespace
{
using testing::HasSubstr;

Ended doctor(const std::string& arguments, const std::string& redirection = "2>/dev/null")
{
  return runProgram(SCANLOOM_BIN_DIR "/scanloom doctor " + arguments + " " + redirection);
}

const std::string kReal = "ouster/ouster-lidar+ouster-sdk/tests/pcaps/OS-1-128_v2.3.0_1024x10";

TEST(Doctor, ofARealCaptureIsATableOfAHundredColumns)
{
  SCANLOOM_NEEDS_DATA(capture, kReal + "_lb_n3.pcap");
  SCANLOOM_NEEDS_DATA(metadata, kReal + ".json");
  const Ended ended = doctor(capture.string() + " --metadata " + metadata.string());
  EXPECT_EQ(ended.status, 0);
  EXPECT_THAT(ended.output, HasSubstr("none of 192 packets"));
  EXPECT_THAT(ended.output, HasSubstr("since boot"));
  std::istringstream lines(ended.output);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

TEST(Doctor, endsWithThreeAndSaysHowToMendWhatIsNotFit)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const std::string config = "-c " SCANLOOM_SOURCE_DIR "/params/dual_os0_recording.ini ";
  ::setenv("SCANLOOM_RECORDING", folder.c_str(), 1);
  const Ended healthy = doctor(config + "--json");
  EXPECT_EQ(healthy.status, 0);
  EXPECT_EQ(nlohmann::json::parse(healthy.output).at("verdict"), "ok");

  const Ended ill = doctor(config + "--set 'lidars.lidar2_pose=[1.5 -1.2 2.5 -30 15 115]'");
  EXPECT_EQ(ill.status, 3);
  EXPECT_THAT(ill.output, HasSubstr("NOT FIT   ground"));
  EXPECT_THAT(ill.output, HasSubstr("the lidar's pose is wrong by 87 deg"));
}

TEST(Doctor, saysWhatIsMissing)
{
  SCANLOOM_NEEDS_DATA(capture, kReal + "_lb_n3.pcap");
  const TemporaryFolder alone;
  std::filesystem::copy(capture, alone / "drive.pcap");
  const Ended without = doctor((alone / "drive.pcap").string(), "2>&1");
  EXPECT_EQ(without.status, 2);
  EXPECT_THAT(without.output, HasSubstr("--metadata"));
  EXPECT_EQ(doctor("").status, 2);
  EXPECT_EQ(doctor("nowhere.pcap --metadata nothing.json").status, 2);
}

TEST(Doctor, namesTheKeyOfAPortThatIsWrong)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  ::setenv("SCANLOOM_RECORDING", folder.c_str(), 1);
  const Ended ended =
      doctor("-c " SCANLOOM_SOURCE_DIR "/params/dual_os0_recording.ini --set lidars.lidar2_port=9999 --seconds 5");
  EXPECT_EQ(ended.status, 3);
  EXPECT_THAT(ended.output, HasSubstr("none at port 9999"));
  EXPECT_THAT(ended.output, HasSubstr("lidar2_port = 7504"));
}
TEST(Doctor, examinesARawlogsOrderAndTimesToo)
{
  const TemporaryFolder folder;
  const std::string rawlog = writeSmallRawlog(folder / "in.rawlog").string();
  const auto json = nlohmann::json::parse(doctor(rawlog + " --json").output);
  EXPECT_EQ(json["rawlog"]["labels"]["lidar"]["count"], 4);
  EXPECT_FALSE(json["findings"].empty());

  std::filesystem::resize_file(rawlog, std::filesystem::file_size(rawlog) * 2 / 3);
  EXPECT_EQ(doctor(rawlog).status, 3) << "damaged";
}
}  // namespace
}  // namespace scanloom::doctor_unittest
