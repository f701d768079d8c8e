/** --web as a person gives it; what the page does: tests/run/page. */
#include "Web.h"

#include <gmock/gmock.h>

#include "base/core/ConfigError.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/runProgram.h"

namespace scanloom::web_unittest
{
TEST(Web, listensAtPort8080UnlessToldOtherwise)
{
  EXPECT_EQ(webAddress({"127.0.0.1"}).port, 8080);
  EXPECT_EQ(webAddress({"192.168.1.7:80"}).port, 80);
  EXPECT_EQ(webAddress({"[::1]:8000"}).port, 8000);
}

TEST(Web, isThisComputersAloneUnlessToldOtherwise)
{
  for (const char* verb : {"slam", "record", "view"})
    EXPECT_THAT(runProgram(std::string(SCANLOOM_BIN_DIR "/scanloom ") + verb + " --help").output,
                testing::ContainsRegex("--web ADDRESS:PORT(=| \\[)127.0.0.1:8080"));  // as CLI11 shows defaults
}

TEST(Web, saysSoIfOtherComputersReachIt)
{
  if (!std::filesystem::exists("/usr/share/javascript/three/three.min.js")) GTEST_SKIP() << "libjs-three is missing";
  const auto announced = [](const char* ip)
  {
    LiveExchange exchange;
    const SensorAddress address{SensorAddress::parse(ip).ip, 0};
    const LiveServer server(address, exchange);
    testing::internal::CaptureStderr();
    announcePage(server.url(), address);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_THAT(announced("0.0.0.0"), testing::HasSubstr("warning: everyone who reaches"));
  EXPECT_THAT(announced("127.0.0.1"), testing::Not(testing::HasSubstr("warning")));
}

TEST(Web, takesNoRecordingForAnAddress)
{
  for (const char* verb : {"slam", "record"})
  {
    const Ended ended = runProgram(std::string(SCANLOOM_BIN_DIR "/scanloom ") + verb + " --web drive.pcap 2>&1");
    EXPECT_EQ(ended.status, 2) << verb;
    EXPECT_THAT(ended.output, testing::HasSubstr("write --web last")) << verb;
  }
}

TEST(Web, changesNoBitOfTheTrajectory)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/dense");
  if (!std::filesystem::exists("/usr/share/javascript/three/three.min.js")) GTEST_SKIP() << "libjs-three is missing";
  const TemporaryFolder folder;
  const auto slam = [&](const std::string& name, const std::string& options)
  {
    const std::string out = (folder / name).string();
    const Ended ended = runProgram(SCANLOOM_BIN_DIR "/scanloom slam " + recording.string() +
                                   " --set output.maps=false --every-nth 3 --out-dir " + out + options + " 2>&1");
    EXPECT_EQ(ended.status, 0) << ended.output;
    return contentOf(folder / name / "trajectory.tum");
  };
  EXPECT_EQ(slam("without", ""), slam("with", " --web=127.0.0.1:18080"));
}
}  // namespace scanloom::web_unittest
