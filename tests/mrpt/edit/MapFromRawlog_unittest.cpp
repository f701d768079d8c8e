#include "mrpt/edit/MapFromRawlog.h"

#include "base/formats/CloudFile.h"
#include "smallRawlog.h"
#include "support/TestData.h"
#include "support/with.h"

#include <gmock/gmock.h>
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
    int keyframes = 0;
    const auto files =
        std::make_shared<MapFiles>(maps, mountedLidars(someHeader().lidars), with(&OctoMapOptions::resolution, 0.2),
                                   offsetFor(trajectory.front().map_T_body));
    readRawlog(in, toMaps(files, {trajectory, 0.5}, someHeader(), [&] { ++keyframes; }),
               [](std::uint64_t) { return true; });
    EXPECT_EQ(files->leftOut(), 0u);
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

TEST_F(MapFromRawlog, inCoordinatesOfACountryKeepsTheDigitsOfOneAtTheOrigin)
{
  const Eigen::Vector3d utm(512'000, 5'412'000, 0);
  Trajectory far = straightOn();
  for (StampedPose& pose : far) pose.map_T_body.translation += utm;
  const auto names = [&](const std::string& stem)
  {
    return std::vector<std::filesystem::path>{folder / (stem + ".ply"), folder / (stem + ".las"),
                                              folder / (stem + ".bt")};
  };
  writeMaps(names("near"), straightOn());
  writeMaps(names("far"), far);

  const auto near_points = readCloud(folder / "near.ply").points, far_points = readCloud(folder / "far.ply").points;
  ASSERT_EQ(near_points.size(), far_points.size());
  for (std::size_t i = 0; i < near_points.size(); ++i) ASSERT_LT((near_points[i] - far_points[i]).norm(), 1e-4);
  EXPECT_THAT(contentOf(folder / "far.ply"), testing::HasSubstr("comment offset 512000 5412000 0\n"));
  EXPECT_EQ(octomap::OcTree((folder / "near.bt").string()).getNumLeafNodes(),
            octomap::OcTree((folder / "far.bt").string()).getNumLeafNodes());
  const std::string las = contentOf(folder / "far.las");
  constexpr std::size_t kOffsets = 155;  // LAS 1.4, table 3
  Eigen::Vector3d offset;
  std::memcpy(offset.data(), las.data() + kOffsets, sizeof offset);
  EXPECT_EQ(offset, utm);
}

TEST_F(MapFromRawlog, aTrajectoryOfAnotherRecordingMakesNoMap)
{
  Trajectory other = straightOn();
  for (StampedPose& pose : other) pose.stamp += 3600s;
  EXPECT_THROW(writeMaps({folder / "k.simplemap"}, other), std::runtime_error);
}
}  // namespace
}  // namespace scanloom::map_from_rawlog_unittest
