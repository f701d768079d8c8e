#include "site/internal/MapTile.h"

#include "mrpt/maps/OctoMapFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace scanloom
{
namespace
{
using Key = std::array<int, 3>;  // of a voxel, x first

constexpr int kLeastMisses = 3;          // rays of other keyframes through a voxel: one may have grazed it
constexpr double kLeastHeight = 1;       // m, of a thing
constexpr std::size_t kLeastVoxels = 5;  // of a thing
constexpr int kOneThing = 4;             // voxels, between two of a thing that are above each other
constexpr double kLeastShare = 0.5;      // of the voxels that it had, gone: a bush that lost some leaves stays

Key keyOf(const octomap::OcTree& tree, const octomap::point3d& at)
{
  const octomap::OcTreeKey key = tree.coordToKey(at);
  return {key[0], key[1], key[2]};
}

octomap::OcTreeKey toOctomap(const Key& key)
{
  return {static_cast<octomap::key_type>(key[0]), static_cast<octomap::key_type>(key[1]),
          static_cast<octomap::key_type>(key[2])};
}

/** `height`: how many voxels up and down count as beside. */
template <typename Visitor>
void forEachBeside(const Key& key, int height, Visitor&& visit)
{
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -height; z <= height; ++z)
        if (x != 0 || y != 0 || z != 0) visit(Key{key[0] + x, key[1] + y, key[2] + z});
}

/** Seen through, with nothing beside it that a pose off by a few centimetres would have put here. */
bool isSeenThrough(const octomap::OcTree& tree, const Key& key)
{
  const octomap::OcTreeNode* node = tree.search(toOctomap(key));
  if (!node || node->getLogOdds() > 0.99F * kLeastMisses * tree.getProbMissLog()) return false;
  bool is_alone = true;
  forEachBeside(key, 1,
                [&](const Key& beside)
                {
                  const octomap::OcTreeNode* other = tree.search(toOctomap(beside));
                  is_alone &= !other || other->getLogOdds() <= 0;
                });
  return is_alone;
}

/** Voxels that were occupied, and whether each is gone. In order, so that results do not depend on the tree's. */
std::map<Key, bool> compared(const octomap::OcTree& before, const octomap::OcTree& after)
{
  std::map<Key, bool> voxels;
  forEachOccupiedVoxel(before,
                       [&](const octomap::point3d& at)
                       {
                         const Key key = keyOf(before, at);
                         voxels[key] = isSeenThrough(after, key);
                       });
  return voxels;
}

/** Groups of gone voxels that touch, or stand above each other: far away, rays meet a stem every 0.5 m of its height.
 */
std::vector<std::vector<Key>> groupsOf(const std::map<Key, bool>& voxels)
{
  std::map<Key, bool> open;
  for (const auto& [key, is_gone] : voxels)
    if (is_gone) open[key] = true;
  std::vector<std::vector<Key>> groups;
  while (!open.empty())
  {
    std::vector<Key> group{open.begin()->first};
    open.erase(open.begin());
    for (std::size_t next = 0; next < group.size(); ++next)
      forEachBeside(Key(group[next]), kOneThing,
                    [&](const Key& beside)
                    {
                      if (open.erase(beside) > 0) group.push_back(beside);
                    });
    groups.push_back(std::move(group));
  }
  return groups;
}

/** Share of the voxels at and beside the group that are gone. */
double shareGone(const std::vector<Key>& group, const std::map<Key, bool>& voxels)
{
  std::map<Key, bool> there;
  for (const Key& key : group)
  {
    there[key] = true;
    forEachBeside(key, 1,
                  [&](const Key& beside)
                  {
                    if (const auto voxel = voxels.find(beside); voxel != voxels.end()) there[beside] = voxel->second;
                  });
  }
  const auto gone = std::count_if(there.begin(), there.end(), [](const auto& voxel) { return voxel.second; });
  return static_cast<double>(gone) / static_cast<double>(there.size());
}

GoneThing thingOf(const std::vector<Key>& group, const octomap::OcTree& tree, std::size_t gone_by)
{
  Eigen::Vector3d least = Eigen::Vector3d::Constant(1e9), most = -least;
  for (const Key& key : group)
  {
    const octomap::point3d at = tree.keyToCoord(toOctomap(key));
    const Eigen::Vector3d p(at.x(), at.y(), at.z());
    least = least.cwiseMin(p), most = most.cwiseMax(p);
  }
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(tree.getResolution() / 2);
  const Eigen::Vector3d size = most - least + 2 * half, middle = (most + least) / 2;
  return {{middle.x(), middle.y(), least.z() - half.z()}, size.z(), std::max(size.x(), size.y()), gone_by};
}

/** The newer drive is as true as all before it together: log odds add up. */
void add(const octomap::OcTree& newer, octomap::OcTree& all)
{
  constexpr bool kInnerNodesLater = true;
  for (auto leaf = newer.begin_leafs(); leaf != newer.end_leafs(); ++leaf)
    all.updateNode(leaf.getKey(), leaf->getLogOdds(), kInnerNodesLater);
}

void forget(const std::vector<Key>& group, octomap::OcTree& tree)
{
  constexpr bool kInnerNodesLater = true;
  for (const Key& key : group) tree.setNodeValue(toOctomap(key), tree.getClampingThresMinLog(), kInnerNodesLater);
}
}  // namespace

OctoMapOptions tileOptions() { return octoMapPreset("preview"); }

MapTile tileOf(const MapArea& area, const std::vector<std::size_t>& drives, const KeyframesOfDrive& keyframes,
               const std::vector<Rigid>& body_T_sensor)
{
  MapTile tile;
  for (const std::size_t drive : drives)
  {
    OctoMapBuilder builder(tileOptions(), body_T_sensor, area);
    keyframes(drive, [&](const Keyframe& keyframe) { builder.add(keyframe); });
    if (!builder.tree().getRoot()) continue;
    if (!tile.tree) tile.tree = std::make_unique<octomap::OcTree>(tileOptions().resolution);
    const std::map<Key, bool> voxels = compared(*tile.tree, builder.tree());
    add(builder.tree(), *tile.tree);
    for (const std::vector<Key>& group : groupsOf(voxels))
    {
      const GoneThing thing = thingOf(group, *tile.tree, drive);
      if (group.size() < kLeastVoxels || thing.height < kLeastHeight || shareGone(group, voxels) < kLeastShare)
        continue;
      tile.gone.push_back(thing);
      for (const Key& key : group) tile.gone_voxels.push_back({toOctomap(key), drive});
      forget(group, *tile.tree);
    }
  }
  if (tile.tree) tile.tree->updateInnerOccupancy();
  return tile;
}
}  // namespace scanloom
