#include "lab/simulation/internal/FoliageVoxels.h"

#include "base/core/VoxelKey.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
FoliageVoxel FoliageVoxel::plant(Surface surface, double extinction)
{
  const int most = kFirstUndergrowth - kFirstCrown;
  const int steps = std::min(most, static_cast<int>(std::lround(extinction / kStep)));
  if (steps <= 0) return {};
  return FoliageVoxel(steps - 1 + (surface == Surface::Crown ? kFirstCrown : kFirstUndergrowth));
}

std::uint64_t keyOf(const Eigen::Array3i& voxel) { return voxelKey(voxel.z(), voxel.y(), voxel.x()); }

FoliageVoxels::FoliageVoxels(double voxel_size, std::vector<GridCell> tiles, double lowest, double highest)
  : voxel_size_(voxel_size),
    tiles_(std::move(tiles)),
    lowest_(static_cast<int>(std::floor(lowest / voxel_size))),
    layers_(static_cast<int>(std::floor(highest / voxel_size)) + 1 - lowest_),
    voxels_(tiles_.size() * static_cast<std::size_t>(layers_ * kTile * kTile))
{
  if (tiles_.empty()) return;
  Eigen::Array2i last = first_tile_ = {tiles_.front().x, tiles_.front().y};
  for (const GridCell& tile : tiles_)
  {
    first_tile_ = first_tile_.min(Eigen::Array2i(tile.x, tile.y));
    last = last.max(Eigen::Array2i(tile.x, tile.y));
  }
  tiles_per_side_ = last - first_tile_ + 1;
  tile_at_.assign(static_cast<std::size_t>(tiles_per_side_.prod()), -1);
  for (std::size_t i = 0; i < tiles_.size(); ++i)
  {
    const Eigen::Array2i tile = Eigen::Array2i(tiles_[i].x, tiles_[i].y) - first_tile_;
    tile_at_[static_cast<std::size_t>(tile.y() * tiles_per_side_.x() + tile.x())] = static_cast<std::int32_t>(i);
  }
}

void FoliageVoxels::add(const Eigen::Array3i& voxel, Surface surface, double extinction)
{
  const std::size_t index = indexOf(voxel.x(), voxel.y(), voxel.z());
  const FoliageVoxel plant = FoliageVoxel::plant(surface, extinction);
  if (index != kOutside && plant.extinction() > voxels_[index].extinction()) voxels_[index] = plant;
}

/** `rows` has a bit per voxel, a tile's row of voxels per word. Sets the bits of all neighbours of set ones, too. */
std::vector<std::uint32_t> FoliageVoxels::grown(const std::vector<std::uint32_t>& rows) const
{
  const auto rowsPerTile = static_cast<std::size_t>(layers_ * kTile);
  const auto rowOf = [&](const std::vector<std::uint32_t>& from, const GridCell& tile, int z, int y) -> std::uint32_t
  {
    const std::int32_t index = tileAt(tile.x, tile.y + (y < 0 ? -1 : y < kTile ? 0 : 1));
    if (index < 0 || z < 0 || z >= layers_) return 0;
    return from[static_cast<std::size_t>(index) * rowsPerTile +
                static_cast<std::size_t>(z * kTile + (y & (kTile - 1)))];
  };
  const auto forEachRow = [&](auto&& rowAt)
  {
    std::vector<std::uint32_t> next;
    next.reserve(rows.size());
    for (const GridCell& tile : tiles_)
      for (int z = 0; z < layers_; ++z)
        for (int y = 0; y < kTile; ++y) next.push_back(rowAt(tile, z, y));
    return next;
  };
  const auto along_x = forEachRow(
      [&](const GridCell& tile, int z, int y)
      {
        const std::uint32_t row = rowOf(rows, tile, z, y);
        const std::uint32_t left = rowOf(rows, {tile.x - 1, tile.y}, z, y) >> (kTile - 1);
        const std::uint32_t right = rowOf(rows, {tile.x + 1, tile.y}, z, y) << (kTile - 1);
        return row | row << 1 | row >> 1 | left | right;
      });
  const auto along_y = forEachRow(
      [&](const GridCell& tile, int z, int y)
      { return rowOf(along_x, tile, z, y - 1) | rowOf(along_x, tile, z, y) | rowOf(along_x, tile, z, y + 1); });
  return forEachRow(
      [&](const GridCell& tile, int z, int y)
      { return rowOf(along_y, tile, z - 1, y) | rowOf(along_y, tile, z, y) | rowOf(along_y, tile, z + 1, y); });
}

void FoliageVoxels::measureOpenSpace()
{
  std::vector<std::uint32_t> rows(voxels_.size() / kTile);
  for (std::size_t i = 0; i < voxels_.size(); ++i)
    if (!voxels_[i].isEmpty()) rows[i / kTile] |= std::uint32_t{1} << (i % kTile);

  for (int around = 0; around < FoliageVoxel::kFarthest; ++around)
  {
    const std::vector<std::uint32_t> next = grown(rows);
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (std::uint32_t reached = next[row] & ~rows[row]; reached != 0; reached &= reached - 1)
        voxels_[row * kTile + static_cast<std::size_t>(__builtin_ctz(reached))] = FoliageVoxel::empty(around);
    rows = next;
  }
  for (std::size_t i = 0; i < voxels_.size(); ++i)
    if ((rows[i / kTile] >> (i % kTile) & 1) == 0) voxels_[i] = FoliageVoxel::empty(FoliageVoxel::kFarthest);
}
}  // namespace scanloom
