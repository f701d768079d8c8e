/** `scanloom map` and `scanloom view` as a person meets them. */
#include "base/formats/CloudFile.h"
#include "base/formats/Trajectory.h"
#include "mrpt/edit/smallRawlog.h"
#include "mrpt/maps/MrptScene.h"
#include "mrpt/maps/OctoMapFile.h"
#include "mrpt/maps/SimpleMapReader.h"
#include "support/ChildProcess.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

namespace scanloom::map_unittest
{
namespace
{
using testing::HasSubstr;

Ended scanloomRuns(const std::string& arguments)
{
  return runProgram(SCANLOOM_BIN_DIR "/scanloom " + arguments + " 2>&1");
}

struct Map : testing::Test
{
  TemporaryFolder folder;
  std::string rawlog = writeSmallRawlog(folder / "in.rawlog").string();
  std::string path = (folder / "path.tum").string();

  Map()
  {
    Trajectory poses;  // 1 m per scan
    for (int i = 0; i < 10; ++i) poses.push_back({kSmallStart + i * 50ms, {{1, 0, 0, 0}, {0.5 * i, 0, 0}}});
    writeTum(path, poses);
  }
  std::string name(const std::string& file) const { return (folder / file).string(); }
  Ended map(const std::string& options) const
  {
    return scanloomRuns("map -i " + rawlog + " --trajectory " + path + " --keyframe-distance 0.9 " + options);
  }
};

TEST_F(Map, makesEveryKindOfARawlogAndItsTrajectory)
{
  const Ended ended = map("-o " + name("m.bt") + " -o " + name("m.ot") + " -o " + name("m.ply") + " -o " +
                          name("m.simplemap") + " -o " + name("m.3Dscene"));
  ASSERT_EQ(ended.status, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("estimate: "));

  EXPECT_EQ(SimpleMapReader(name("m.simplemap")).size(), 4U);
  EXPECT_EQ(readCloud(name("m.ply")).points.size(), 360U);
  octomap::OcTree stock(name("m.bt"));
  EXPECT_GT(stock.size(), 100U);
  EXPECT_DOUBLE_EQ(stock.getResolution(), 0.1);
  MrptScene scene;
  EXPECT_TRUE(scene.loadFromFile(name("m.3Dscene")));
  EXPECT_TRUE(scene.getByClass<viz::CRenderizable>());
}

TEST_F(Map, ofKeyframesIsThatOfTheRawlog)
{
  ASSERT_EQ(map("-o " + name("m.ot") + " -o " + name("m.simplemap")).status, 0);
  ASSERT_EQ(scanloomRuns("map -i " + name("m.simplemap") + " -o " + name("again.ot")).status, 0);
  // Coordinates went through floats in another frame: voxels at a border may differ.
  const auto first = readOctoMap(name("m.ot")), again = readOctoMap(name("again.ot"));
  EXPECT_NEAR(static_cast<double>(again->size()), static_cast<double>(first->size()),
              0.03 * static_cast<double>(first->size()));
}

TEST_F(Map, convertsOccupancyToPoints)
{
  ASSERT_EQ(map("--preset preview -o " + name("m.bt")).status, 0);
  ASSERT_EQ(scanloomRuns("map -i " + name("m.bt") + " -o " + name("m.ply")).status, 0);
  const auto cloud = readCloud(name("m.ply"));
  const octomap::OcTree stock(name("m.bt"));
  ASSERT_GT(cloud.points.size(), 0U);
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
  {
    const auto* node = stock.search(cloud.points[i].x(), cloud.points[i].y(), cloud.points[i].z());
    ASSERT_TRUE(node && stock.isNodeOccupied(node));
  }
}

TEST_F(Map, whatMakesNoSenseIsStatus2)
{
  EXPECT_EQ(map("-o " + name("m.xyz")).status, 2);
  EXPECT_EQ(map("-o " + name("a.bt") + " -o " + name("b.bt")).status, 2);
  EXPECT_EQ(map("-o " + name("m.bt") + " --preset coarse").status, 2);
  EXPECT_EQ(scanloomRuns("map -i " + rawlog + " -o " + name("m.bt")).status, 2) << "no trajectory";
  ASSERT_EQ(map("-o " + name("m.bt")).status, 0);
  EXPECT_EQ(map("-o " + name("m.bt")).status, 2) << "exists";
  EXPECT_EQ(map("-w -o " + name("m.bt")).status, 0);
  EXPECT_EQ(scanloomRuns("map -i " + name("m.bt") + " -o " + name("m.simplemap")).status, 2);
}

TEST_F(Map, beginsWithAnEstimate) { EXPECT_THAT(map("-o " + name("m.bt")).output, HasSubstr("0.1 m / 20 m")); }

TEST_F(Map, anInterruptedMapReplacesNoWholeOne)
{
  writeSmallRawlog(rawlog, 100);
  Trajectory poses;
  for (int i = 0; i < 300; ++i) poses.push_back({kSmallStart + i * 50ms, {{1, 0, 0, 0}, {0.5 * i, 0, 0}}});
  writeTum(path, poses);
  const std::string options = "--preset fine -o " + name("m.bt");
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(map(options).status, 0);
  const std::chrono::duration<double, std::micro> length = std::chrono::steady_clock::now() - start;
  const std::string whole = contentOf(name("m.bt"));
  std::ofstream(name("m.bt")) << "good";
  for (const double share : {0.5, 0.7})
  {
    ChildProcess child(SCANLOOM_BIN_DIR "/scanloom map -w -i " + rawlog + " --trajectory " + path +
                           " --keyframe-distance 0.9 " + options,
                       folder / "log.txt");
    usleep(static_cast<unsigned>(share * length.count()));
    child.send(SIGTERM);
    const int status = child.wait();
    const std::string now = contentOf(name("m.bt"));
    ASSERT_TRUE(now == (status == 0 ? whole : "good")) << status << ": " << child.log();
    std::ofstream(name("m.bt")) << "good";
  }
}

TEST_F(Map, anOutputIsNeverAnInput)
{
  ASSERT_EQ(map("-o " + name("m.ot") + " -o " + name("m.simplemap")).status, 0);
  const std::string before = contentOf(name("m.ot")), trajectory = contentOf(path);
  std::filesystem::create_symlink(name("m.ot"), name("link.ot"));
  EXPECT_EQ(scanloomRuns("map -w -i " + name("m.ot") + " -o " + name("link.ot")).status, 2);
  EXPECT_EQ(scanloomRuns("map -w -i " + path + " -o " + path).status, 2);
  EXPECT_EQ(scanloomRuns("map -w -i " + name("m.simplemap") + " -o " + name("m.simplemap")).status, 2);
  EXPECT_TRUE(contentOf(name("m.ot")) == before);
  EXPECT_EQ(contentOf(path), trajectory);
}

TEST_F(Map, aTrajectoryOfAnotherDayIsStatus1)
{
  writeTum(path, {{kSmallStart + 3600s, Rigid::identity()}, {kSmallStart + 3601s, Rigid::identity()}});
  const Ended ended = map("-o " + name("m.bt"));
  EXPECT_EQ(ended.status, 1);
  EXPECT_THAT(ended.output, HasSubstr("no scan lies within the trajectory"));
  EXPECT_FALSE(std::filesystem::exists(name("m.bt")));
}

std::size_t colorsOf(const std::string& png)
{
  mrpt::img::CImage image;
  if (!image.loadFromFile(png)) return 0;
  std::set<std::uint32_t> colors;
  for (int y = 0; y < static_cast<int>(image.getHeight()); ++y)
    for (int x = 0; x < static_cast<int>(image.getWidth()); ++x)
    {
      const auto* pixel = image.ptr<std::uint8_t>(static_cast<unsigned>(x), static_cast<unsigned>(y));
      colors.insert(pixel[0] | pixel[1] << 8 | pixel[2] << 16);
    }
  return colors.size();
}

TEST_F(Map, viewDrawsAPictureOfEachWithoutADisplay)
{
  ASSERT_EQ(map("-o " + name("m.bt") + " -o " + name("m.ply") + " -o " + name("m.simplemap")).status, 0);
  for (const std::string& file : {rawlog, path, name("m.bt"), name("m.ply"), name("m.simplemap")})
  {
    const Ended ended =
        runProgram("env -u DISPLAY " SCANLOOM_BIN_DIR "/scanloom view " + file + " --png " + file + ".png 2>&1");
    ASSERT_EQ(ended.status, 0) << ended.output;
    EXPECT_GE(colorsOf(file + ".png"), file == path ? 3U : 10U) << file << ": not only the background";
  }
}

TEST_F(Map, viewSaysWhatItCannotShow)
{
  std::ofstream(name("m.las")) << "las";
  EXPECT_EQ(scanloomRuns("view " + name("m.las") + " --png " + name("m.png")).status, 2);
  EXPECT_EQ(scanloomRuns("view " + rawlog + " --png " + name("m.jpg")).status, 2);
  const Ended beyond = scanloomRuns("view " + rawlog + " --scan 9 --png " + name("m.png"));
  EXPECT_EQ(beyond.status, 1);
  EXPECT_THAT(beyond.output, HasSubstr("has 4 point clouds, so there is no number 9"));
  const Ended blind =
      runProgram("env -u DISPLAY -u WAYLAND_DISPLAY " SCANLOOM_BIN_DIR "/scanloom view " + path + " 2>&1");
  EXPECT_EQ(blind.status, 1);
  EXPECT_THAT(blind.output, HasSubstr("--png"));
}
/** A quarter turn to the left about z at (1, 2, 3), written down by hand in all three formats. */
struct Trajectories : testing::Test
{
  TemporaryFolder folder;
  const std::string tum =
      "1403636579.763555584 1.000000000 2.000000000 3.000000000 0.000000000 0.000000000 0.707106781 0.707106781\n";
  const std::string euroc =
      "#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w [],q_x [],q_y [],q_z []\n"
      "1403636579763555584,1.000000000,2.000000000,3.000000000,0.707106781,0.000000000,0.000000000,0.707106781\n";
  const std::string times = "1403636579.763555584\n";

  std::string name(const std::string& file) const { return (folder / file).string(); }
  std::string write(const std::string& file, const std::string& text) const
  {
    std::ofstream(folder / file) << text;
    return name(file);
  }
};

TEST_F(Trajectories, becomeEurocAndKitti)
{
  const Ended ended = scanloomRuns("map -i " + write("t.tum", tum) + " -o " + name("e.csv") + " -o " + name("k.txt"));
  ASSERT_EQ(ended.status, 0) << ended.output;
  EXPECT_EQ(contentOf(name("e.csv")), euroc);
  EXPECT_EQ(contentOf(name("k_times.txt")), times);
  std::istringstream row(contentOf(name("k.txt")));
  for (const double expected : {0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3})
  {
    double number = NAN;
    row >> number;
    EXPECT_NEAR(number, expected, 1e-8);
  }
}

TEST_F(Trajectories, becomeTumFromEurocAndFromKitti)
{
  write("k.txt", "0 -1 0 1 1 0 0 2 0 0 1 3\n");
  write("k_times.txt", times);
  for (const std::string& input : {write("e.csv", euroc), name("k.txt")})
  {
    ASSERT_EQ(scanloomRuns("map -w -i " + input + " -o " + name("t.tum")).status, 0);
    EXPECT_EQ(contentOf(name("t.tum")), tum) << input;
  }
}

TEST_F(Trajectories, areNotReplacedUnaskedNorMadeIntoMaps)
{
  const std::string input = write("t.tum", tum);
  write("k_times.txt", "mine");
  EXPECT_EQ(scanloomRuns("map -i " + input + " -o " + name("k.txt")).status, 2) << "its stamps would be replaced";
  EXPECT_EQ(contentOf(name("k_times.txt")), "mine");
  EXPECT_EQ(scanloomRuns("map -i " + input + " -o " + name("m.bt")).status, 2);
  EXPECT_EQ(scanloomRuns("map -i " + write("empty.tum", "# none\n") + " -o " + name("t.csv")).status, 1);
}

TEST_F(Map, refusesToListAHugeLeafAndSaysHowHuge)
{
  std::ofstream(name("huge.bt"), std::ios::binary) << "# Octomap OcTree binary file\nid OcTree\nsize 2\nres 0.1\ndata\n"
                                                   << '\2' << '\0';
  for (const char* output : {"m.ply", "m.3Dscene"})
  {
    const Ended ended = scanloomRuns("map -i " + name("huge.bt") + " -o " + name(output));
    EXPECT_EQ(ended.status, 1) << ended.output;
    EXPECT_THAT(ended.output, HasSubstr("35184372088832 voxels"));
    EXPECT_FALSE(std::filesystem::exists(name(output)));
  }
}
}  // namespace
}  // namespace scanloom::map_unittest
