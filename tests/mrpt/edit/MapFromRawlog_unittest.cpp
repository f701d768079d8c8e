#include "mrpt/edit/MapFromRawlog.h"

#include "smallRawlog.h"

#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <octomap/octomap.h>

namespace scanloom::map_from_rawlog_unittest
{
namespace
{
struct MapFromRawlog : testing::Test
{
  TemporaryFolder folder;
  std::filesystem::path in = writeSmallRawlog(folder / "in.rawlog");

  /** With keyframes each 0.5 m and voxels of 0.2 m. @return the number of keyframes. */
  int writeMaps(const std::vector<std::filesystem::path>& maps, const Trajectory& trajectory) const
  {
    OctoMapOptions options;
    options.resolution = 0.2;
    int keyframes = 0;
    readRawlog(in, toMaps(maps, options, {trajectory, 0.5}, someHeader(), [&] { ++keyframes; }),
               [](std::uint64_t) { return true; });
    return keyframes;
  }
};

TEST_F(MapFromRawlog, aSimplemapHoldsKeyframesAtTheirPoses)
{
  const std::string map = (folder / "k.simplemap").string();
  EXPECT_EQ(writeMaps({map}, straightOn()), 2) << "at 0.05 m and 1.05 m";

  mrpt::maps::CSimpleMap read;
  ASSERT_TRUE(read.loadFromFile(map));
  EXPECT_EQ(read.size(), 2u);
}

TEST_F(MapFromRawlog, anOctomapIsWrittenInBothForms)
{
  writeMaps({folder / "m.bt", folder / "m.ot"}, straightOn());
  octomap::OcTree tree((folder / "m.bt").string());
  EXPECT_GT(tree.getNumLeafNodes(), 50u);
  EXPECT_TRUE(std::filesystem::exists(folder / "m.ot"));
}

TEST_F(MapFromRawlog, aTrajectoryOfAnotherRecordingMakesNoMap)
{
  Trajectory other = straightOn();
  for (StampedPose& pose : other) pose.stamp += 3600s;
  EXPECT_THROW(writeMaps({folder / "k.simplemap"}, other), std::runtime_error);
}
}  // namespace
}  // namespace scanloom::map_from_rawlog_unittest
