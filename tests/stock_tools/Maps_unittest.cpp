/** Our maps in the programs that people open them with. */
#include "mrpt/maps/MapFiles.h"
#include "mrpt/maps/SimpleMapFile.h"
#include "screen.h"
#include "stockTool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace scanloom::maps_unittest
{
namespace
{
using testing::HasSubstr;

constexpr std::size_t kPoints = 3000;

/** A helix around the body, a turn seen by each of two lidars. */
Keyframe someKeyframe(int index)
{
  Keyframe keyframe{fromNanoseconds(1'700'000'000'000'000'000) + index * 1s, {}, {}};
  keyframe.map_T_body.translation.x() = 2.0 * index;
  keyframe.points.resize(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i)
  {
    const double angle = 4 * M_PI * static_cast<double>(i) / kPoints;
    keyframe.points.x[i] = static_cast<float>(5 * std::cos(angle));
    keyframe.points.y[i] = static_cast<float>(5 * std::sin(angle));
    keyframe.points.z[i] = static_cast<float>(0.5 * angle);
    keyframe.points.sensor_id[i] = i < kPoints / 2 ? 0 : 1;
  }
  return keyframe;
}

struct StockMaps : testing::Test
{
  TemporaryFolder folder;

  void SetUp() override
  {
    const std::vector<MountedLidar> lidars{{"left", Rigid::fromXyzYawPitchRoll(0, 1, 1, 0, 0, 0)},
                                           {"right", Rigid::fromXyzYawPitchRoll(0, -1, 1, 0, 0, 0)}};
    MapFiles files({folder / "m.bt", folder / "m.ot", folder / "m.3Dscene"}, lidars, octoMapPreset("preview"));
    SimpleMapWriter keyframes(folder / "m.simplemap", lidars,
                              CloudClass::CPointsMapXYZI);  // stock tools of MRPT 2.5 load no plugin
    for (int i = 0; i < 3; ++i)
    {
      files.add(someKeyframe(i));
      keyframes.add({someKeyframe(i)});
    }
    files.close();
    keyframes.close();
  }
  std::string in(const std::string& command) const
  {
    return outputOf("cd " + folder.path().string() + " && " + command);
  }
};

#define SCANLOOM_NEEDS_OCTOMAP_TOOL(name) \
  if (!scanloom::isInstalled(name)) GTEST_SKIP() << name << " is not installed (package octomap-tools)"

TEST_F(StockMaps, octomapsOwnToolsReadBothTrees)
{
  SCANLOOM_NEEDS_OCTOMAP_TOOL("compare_octrees");
  EXPECT_THAT(in("convert_octree m.bt converted.ot"), HasSubstr("Finished writing"));
  const std::string same = in("compare_octrees m.ot m.ot");
  EXPECT_THAT(same, HasSubstr("KLD: 0\n"));
  const std::string binary_against_log_odds = in("compare_octrees m.ot converted.ot");
  EXPECT_THAT(binary_against_log_odds, HasSubstr("KLD: "))
      << "the same leaves, or it stops: " << binary_against_log_odds;
}

TEST_F(StockMaps, observations2mapReadsEveryPointOfBothLidars)
{
  SCANLOOM_NEEDS_PROGRAM("observations2map");
  std::ofstream(folder / "m.ini") << "[MappingApplication]\npointsMap_count = 1\n"
                                     "[MappingApplication_pointsMap_00_insertOpts]\nminDistBetweenLaserPoints = 0\n"
                                     "fuseWithExisting = false\n";
  const std::string log = in("echo | observations2map m.ini m.simplemap points");
  const std::string points = contentOf(folder / "points_mrpt__maps__CSimplePointsMap_00.txt");
  EXPECT_EQ(std::count(points.begin(), points.end(), '\n'), static_cast<long>(3 * kPoints)) << log;
}

bool isColoured(Color8 c) { return std::max({c.red, c.green, c.blue}) - std::min({c.red, c.green, c.blue}) > 150; }

TEST_F(StockMaps, sceneViewerAndOurOwnWindowShowThePoints)
{
  SCANLOOM_NEEDS_PROGRAM("SceneViewer3D");
  if (!isInstalled("Xvfb")) GTEST_SKIP() << "Xvfb is not installed (package xvfb)";
  const TemporaryFolder screen_folder;
  VirtualScreen screen(screen_folder);
  for (const std::string& command : {"SceneViewer3D " + (folder / "m.3Dscene").string(),
                                     SCANLOOM_BIN_DIR "/scanloom view " + (folder / "m.simplemap").string()})
  {
    ASSERT_EQ(screen.waitForPixels([](Color8 c) { return !isColoured(c); }, kPixelsOfTheScreen), kPixelsOfTheScreen)
        << "nothing there yet";
    ChildProcess viewer("env LIBGL_ALWAYS_SOFTWARE=1 DISPLAY=" + screen.name() + " " + command, folder / "log.txt");
    EXPECT_GE(screen.waitForPixels(&isColoured, 100), 100u) << command << viewer.log();
    viewer.send(SIGKILL);
    viewer.wait();
  }
}
}  // namespace
}  // namespace scanloom::maps_unittest
