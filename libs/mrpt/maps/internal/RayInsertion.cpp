#include "mrpt/maps/internal/RayInsertion.h"

#include "mrpt/maps/internal/RayWalk.h"
#include "mrpt/maps/internal/VoxelMarks.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace scanloom
{
namespace
{
/** The voxels that contain points, in the tree's order. One ray serves all points of a voxel. */
std::vector<MortonCode> endsOf(const octomap::OcTree& tree, const octomap::Pointcloud& points)
{
  std::vector<MortonCode> ends;
  for (const octomap::point3d& point : points)
    if (octomap::OcTreeKey key; tree.coordToKeyChecked(point, key)) ends.push_back(codeOf(key));
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

void markRay(VoxelMarks& marks, const octomap::OcTree& tree, const octomap::point3d& origin, MortonCode end_voxel,
             double max_range)
{
  octomap::point3d end = tree.keyToCoord(keyOf(end_voxel));
  const bool in_reach = (end - origin).norm() <= max_range;
  if (in_reach) marks.occupy(end_voxel);
  if (!in_reach) end = origin + (end - origin).normalized() * static_cast<float>(max_range);
  forEachVoxelBefore(tree, origin, end, [&](MortonCode voxel) { marks.touch(voxel); });
}

VoxelMarks marksOf(const octomap::OcTree& tree, const octomap::Pointcloud& points, const octomap::point3d& origin,
                   double max_range)
{
  constexpr std::size_t kGrain = 4096;  // rays
  const std::vector<MortonCode> ends = endsOf(tree, points);
  tbb::enumerable_thread_specific<VoxelMarks> by_thread;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, ends.size(), kGrain),
                    [&](const auto& range)
                    {
                      VoxelMarks& marks = by_thread.local();
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        markRay(marks, tree, origin, ends[i], max_range);
                    });
  VoxelMarks all;
  for (VoxelMarks& marks : by_thread) all.merge(std::move(marks));
  return all;
}

/** Updates each marked voxel of a block once, in one descent through the block's branches. */
class BlockUpdate
{
 public:
  BlockUpdate(octomap::OcTree& tree, const VoxelMarks::NumberedBlock& marks) : tree_(tree), marks_(marks) {}

  void run()
  {
    Branch branch{tree_.getRoot(), false};
    const int levels_above = static_cast<int>(tree_.getTreeDepth()) - VoxelBlock::kLevels;
    for (int level = levels_above - 1; level >= 0; --level)
    {
      if (isFinal(branch, 0, VoxelBlock::kVoxels)) return;
      branch = child(branch, static_cast<unsigned>(marks_.number >> (3 * level) & 7));
    }
    update(branch, 0, VoxelBlock::kVoxels);
  }

 private:
  struct Branch
  {
    octomap::OcTreeNode* node;
    bool is_new;
  };

  /** Whether a pruned leaf, which stands for all its voxels, may stay one: it does where its log odds are clamped. */
  bool isFinal(const Branch& branch, std::size_t first, std::size_t count)
  {
    if (branch.is_new || tree_.nodeHasChildren(branch.node)) return false;
    const float log_odds = branch.node->getLogOdds();
    if (stays(log_odds, first, count)) return true;
    tree_.expandNode(branch.node);
    return false;
  }

  bool stays(float log_odds, std::size_t first, std::size_t count) const
  {
    for (std::size_t voxel = first; voxel < first + count; ++voxel)
      if (isSet(marks_.block->touched, voxel))
        if (isSet(marks_.block->occupied, voxel) ? log_odds < tree_.getClampingThresMaxLog()
                                                 : log_odds > tree_.getClampingThresMinLog())
          return false;
    return true;
  }

  Branch child(const Branch& branch, unsigned index)
  {
    if (tree_.nodeChildExists(branch.node, index)) return {tree_.getNodeChild(branch.node, index), false};
    return {tree_.createNodeChild(branch.node, index), true};
  }

  void update(const Branch& branch, std::size_t first, std::size_t count)
  {
    if (count == 1) return updateLeaf(*branch.node, isSet(marks_.block->occupied, first));
    if (isFinal(branch, first, count)) return;
    const std::size_t part = count / 8;
    for (unsigned index = 0; index < 8; ++index)
      if (const std::size_t from = first + index * part; anyTouched(from, part))
        update(child(branch, index), from, part);
  }

  void updateLeaf(octomap::OcTreeNode& leaf, bool hit)
  {
    const float change = hit ? tree_.getProbHitLog() : tree_.getProbMissLog();
    leaf.setLogOdds(
        std::clamp(leaf.getLogOdds() + change, tree_.getClampingThresMinLog(), tree_.getClampingThresMaxLog()));
  }

  bool anyTouched(std::size_t first, std::size_t count) const
  {
    const VoxelBlock::Bits& bits = marks_.block->touched;
    if (count < 64) return bits[first / 64] >> (first % 64) & ((std::uint64_t{1} << count) - 1);
    const auto word = bits.begin() + static_cast<std::ptrdiff_t>(first / 64);
    return std::any_of(word, word + static_cast<std::ptrdiff_t>(count / 64), [](std::uint64_t w) { return w != 0; });
  }

  static bool isSet(const VoxelBlock::Bits& bits, std::size_t voxel) { return bits[voxel / 64] >> (voxel % 64) & 1; }

  octomap::OcTree& tree_;
  const VoxelMarks::NumberedBlock& marks_;
};

/** By setting a voxel that is updated next: only the tree itself can create its root. */
void makeRoot(octomap::OcTree& tree, const VoxelMarks::NumberedBlock& marks)
{
  std::size_t voxel = 0;
  while (!(marks.block->touched[voxel / 64] >> (voxel % 64) & 1)) ++voxel;
  constexpr bool kInnerNodesLater = true;
  tree.setNodeValue(keyOf(marks.number * VoxelBlock::kVoxels + voxel), 0.0F, kInnerNodesLater);
}
bool isIn(const MapArea& area, const octomap::OcTree& tree, const VoxelMarks::NumberedBlock& block)
{
  const octomap::point3d corner = tree.keyToCoord(keyOf(block.number * VoxelBlock::kVoxels));  // middle of a voxel
  const Eigen::Array2d within = Eigen::Array2d(corner.x(), corner.y()) - area.least.array();
  return (within >= 0).all() && (within < area.edge).all();
}
}  // namespace

void insertRays(octomap::OcTree& tree, const octomap::Pointcloud& points, const octomap::point3d& origin,
                double max_range, const std::optional<MapArea>& area)
{
  const VoxelMarks marks = marksOf(tree, points, origin, max_range);
  for (const VoxelMarks::NumberedBlock& block : marks.blocks())
  {
    if (area && !isIn(*area, tree, block)) continue;
    if (!tree.getRoot()) makeRoot(tree, block);
    BlockUpdate(tree, block).run();
  }
}
}  // namespace scanloom
