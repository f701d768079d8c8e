/** Windows of our own, on a screen in memory. */
#include "screen.h"
#include "support/TestData.h"
#include "support/runProgram.h"

#include <gtest/gtest.h>

namespace scanloom::live_window_unittest
{
namespace
{
bool isLeft(Color8 c) { return c.red == 10 && c.green == 124 && c.blue == 255; }
bool isRight(Color8 c) { return c.red == 255 && c.green == 122 && c.blue == 0; }

#define SCANLOOM_NEEDS_SCREEN \
  if (!isInstalled("Xvfb")) GTEST_SKIP() << "Xvfb is not installed (package xvfb)"

std::string onScreen(const VirtualScreen& screen, const std::string& arguments)
{
  return "env LIBGL_ALWAYS_SOFTWARE=1 DISPLAY=" + screen.name() + " " SCANLOOM_BIN_DIR "/scanloom " + arguments;
}

TEST(LiveWindow, viewPlaysARecordingInTheLidarsColours)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/dense");
  SCANLOOM_NEEDS_SCREEN;
  const TemporaryFolder folder;
  VirtualScreen screen(folder);
  ChildProcess viewer(onScreen(screen, "view " + recording.string()), folder / "log.txt");
  EXPECT_GE(screen.waitForPixels(&isLeft, 100), 100u) << viewer.log();
  EXPECT_GE(screen.waitForPixels(&isRight, 100), 100u) << viewer.log();
  viewer.send(SIGINT);
  EXPECT_EQ(viewer.wait(), 0) << viewer.log();
}

TEST(LiveWindow, changesNoBitOfTheTrajectory)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/dense");
  SCANLOOM_NEEDS_SCREEN;
  const TemporaryFolder folder;
  const VirtualScreen screen(folder);
  const auto slam = [&](const std::string& name, const std::string& option)
  {
    const Ended ended =
        runProgram(onScreen(screen, "slam " + recording.string() + " --set output.maps=false --every-nth 3 --out-dir " +
                                        (folder / name).string() + option + " 2>&1"));
    EXPECT_EQ(ended.status, 0) << ended.output;
    return contentOf(folder / name / "trajectory.tum");
  };
  EXPECT_EQ(slam("without", ""), slam("with", " --window"));
}

TEST(LiveWindow, isRefusedWithoutADisplay)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/dense");
  const Ended ended = runProgram("env -u DISPLAY -u WAYLAND_DISPLAY " SCANLOOM_BIN_DIR "/scanloom view " +
                                 recording.string() + " 2>&1");
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.output.find("there is no display for a window: use --web"), std::string::npos) << ended.output;
}
}  // namespace
}  // namespace scanloom::live_window_unittest
