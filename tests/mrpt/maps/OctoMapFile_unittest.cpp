#include "mrpt/maps/OctoMapFile.h"

#include "mrpt/maps/internal/VoxelPly.h"
#include "support/TemporaryFolder.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstring>

namespace scanloom::octo_map_file_unittest
{
namespace
{
/** Two occupied voxels far apart, a pruned cube of eight, and a free one; edge 0.5 m. */
octomap::OcTree someTree()
{
  octomap::OcTree tree(0.5);
  for (const float x : {0.25F, 0.75F})
    for (const float y : {0.25F, 0.75F})
      for (const float z : {0.25F, 0.75F}) tree.updateNode(octomap::point3d(x, y, z), true);
  tree.updateNode(octomap::point3d(10.25F, -3.25F, 1.25F), true);
  tree.updateNode(octomap::point3d(-7.75F, 3.25F, 1.25F), true);
  tree.updateNode(octomap::point3d(5.25F, 5.25F, 5.25F), false);
  tree.updateInnerOccupancy();
  tree.prune();
  return tree;
}

struct OctoMapFile : testing::Test
{
  TemporaryFolder folder;
  octomap::OcTree tree = someTree();
};

TEST_F(OctoMapFile, readsWhatOctomapItselfWrote)
{
  ASSERT_TRUE(tree.write((folder / "m.ot").string()));
  EXPECT_TRUE(*readOctoMap(folder / "m.ot") == tree);

  ASSERT_TRUE(tree.writeBinary((folder / "m.bt").string()));
  EXPECT_TRUE(*readOctoMap(folder / "m.bt") == tree) << "OctoMap made it most likely as it wrote";
}

TEST_F(OctoMapFile, refusesWhatIsCutOrForeign)
{
  writeFullOctoMap(folder / "m.ot", tree);
  writeBinaryOctoMap(folder / "m.bt", tree);
  for (const char* name : {"m.ot", "m.bt"})
  {
    std::filesystem::resize_file(folder / name, std::filesystem::file_size(folder / name) - 3);
    EXPECT_THROW(readOctoMap(folder / name), std::runtime_error) << name;
  }
  std::ofstream(folder / "text.bt") << "not a map\n";
  EXPECT_THROW(readOctoMap(folder / "text.bt"), std::runtime_error);
  EXPECT_THROW(readOctoMap(folder / "nowhere.bt"), std::runtime_error);
}

TEST_F(OctoMapFile, refusesEveryBeginningOfAFile)
{
  writeFullOctoMap(folder / "m.ot", tree);
  writeBinaryOctoMap(folder / "m.bt", tree);
  for (const char* name : {"m.ot", "m.bt"})
    for (std::uintmax_t size = std::filesystem::file_size(folder / name); size-- > 0;)
    {
      std::filesystem::resize_file(folder / name, size);
      ASSERT_THROW(readOctoMap(folder / name), std::runtime_error) << name << ' ' << size;
    }
}

TEST_F(OctoMapFile, refusesABranchWithoutEnd)
{
  std::ofstream file(folder / "deep.bt", std::ios::binary);
  file << "# Octomap OcTree binary file\nid OcTree\nsize 40\nres 0.1\ndata\n";
  for (int i = 0; i < 40; ++i) file.write("\3\0", 2);  // the first child is a branch
  file.close();
  EXPECT_THROW(readOctoMap(folder / "deep.bt"), std::runtime_error);
}

TEST_F(OctoMapFile, aPrunedLeafIsAllTheVoxelsThatItStandsFor)
{
  std::vector<std::array<float, 3>> centres;
  forEachOccupiedVoxel(tree, [&](const octomap::point3d& p) { centres.push_back({p.x(), p.y(), p.z()}); });

  EXPECT_THAT(centres,
              testing::UnorderedElementsAre(std::array{0.25F, 0.25F, 0.25F}, std::array{0.25F, 0.25F, 0.75F},
                                            std::array{0.25F, 0.75F, 0.25F}, std::array{0.25F, 0.75F, 0.75F},
                                            std::array{0.75F, 0.25F, 0.25F}, std::array{0.75F, 0.25F, 0.75F},
                                            std::array{0.75F, 0.75F, 0.25F}, std::array{0.75F, 0.75F, 0.75F},
                                            std::array{10.25F, -3.25F, 1.25F}, std::array{-7.75F, 3.25F, 1.25F}));
}

std::string bodyOf(const std::string& ply)
{
  const std::string end = "end_header\n";
  return ply.substr(ply.find(end) + end.size());
}

TEST_F(OctoMapFile, centresAreTheVerticesOfAPly)
{
  writeVoxelPly(folder / "m.ply", tree);
  const std::string ply = contentOf(folder / "m.ply");

  EXPECT_THAT(ply, testing::HasSubstr("element vertex 10\n"));
  EXPECT_EQ(bodyOf(ply).size(), 10U * 3 * sizeof(float));
}

/** As a damaged byte makes it: the root's child in a .bt is an occupied leaf of 3276.8 m. */
struct HugeLeaf : testing::Test
{
  TemporaryFolder folder;
  std::filesystem::path path = folder / "huge.bt";

  HugeLeaf()
  {
    constexpr char kFirstChildIsOccupied = 2;
    std::ofstream file(path, std::ios::binary);
    file << "# Octomap OcTree binary file\nid OcTree\nsize 2\nres 0.1\ndata\n" << kFirstChildIsOccupied << '\0';
  }
};

TEST_F(HugeLeaf, isOneLeafToOctomapAndHasTheVolumeOfAllItsVoxels)
{
  octomap::OcTree stock(path.string());
  ASSERT_EQ(stock.size(), 2U);
  ASSERT_TRUE(stock.isNodeOccupied(*stock.begin_leafs()));
  EXPECT_DOUBLE_EQ(static_cast<double>(occupiedVoxels(*readOctoMap(path))),
                   std::pow(stock.begin_leafs().getSize() / 0.1, 3));
}

TEST_F(HugeLeaf, isNotListedVoxelByVoxel)
{
  const auto tree = readOctoMap(path);
  EXPECT_THAT(
      messageOf<std::runtime_error>([&] { writeVoxelPly(folder / "m.ply", *tree); }),
      testing::AllOf(testing::HasSubstr("35184372088832 voxels of 0.1 m"), testing::HasSubstr("a cube of 3276.8 m")));
  EXPECT_FALSE(std::filesystem::exists(folder / "m.ply"));
}
}  // namespace
}  // namespace scanloom::octo_map_file_unittest
