#pragma once
#include "lab/simulation/internal/Lane.h"
#include "lab/simulation/internal/Ray.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace scanloom
{
/** A voxel in one byte: how empty its surroundings are, or what grows in it and how densely. */
class FoliageVoxel
{
 public:
  /** Empty, as is every voxel that differs by at most `around` in each coordinate. `around` is at most kFarthest. */
  static constexpr int kFarthest = 15;
  static FoliageVoxel empty(int around) { return FoliageVoxel(around); }

  /** `extinction` in 1/m is rounded to steps of 0.02 and limited to 2.4; below 0.01 the voxel is empty. */
  static FoliageVoxel plant(Surface, double extinction);

  FoliageVoxel() = default;

  bool isEmpty() const { return byte_ < kFirstCrown; }
  int around() const { return isEmpty() ? byte_ : 0; }
  Surface surface() const { return byte_ < kFirstUndergrowth ? Surface::Crown : Surface::Undergrowth; }

  /** 1/m */
  double extinction() const
  {
    return isEmpty() ? 0 : kStep * (1 + byte_ - (byte_ < kFirstUndergrowth ? kFirstCrown : kFirstUndergrowth));
  }

 private:
  explicit FoliageVoxel(int byte) : byte_(static_cast<std::uint8_t>(byte)) {}

  static constexpr double kStep = 0.02;  // 1/m
  static constexpr int kFirstCrown = kFarthest + 1, kFirstUndergrowth = kFirstCrown + 120;

  std::uint8_t byte_ = 0;
};

/** The voxels of a world in square tiles, all from the same lowest to the same highest layer. */
class FoliageVoxels
{
 public:
  static constexpr int kTile = 32;  // voxels along a horizontal edge

  /** All voxels are empty. `tiles` are grid cells with an edge of kTile voxels; `lowest` and `highest` are in m. */
  FoliageVoxels(double voxel_size, std::vector<GridCell> tiles, double lowest, double highest);

  double voxelSize() const { return voxel_size_; }
  int lowest() const { return lowest_; }           // in voxels
  int above() const { return lowest_ + layers_; }  // in voxels: the layer above the highest one

  Eigen::Vector3d centreOf(const Eigen::Array3i& voxel) const { return voxel_size_ * (voxel.cast<double>() + 0.5); }
  Eigen::Array3i voxelAt(const Eigen::Vector3d& p) const { return (p.array() / voxel_size_).floor().cast<int>(); }

  /** Empty outside the tiles. */
  FoliageVoxel at(int x, int y, int z) const
  {
    const std::size_t index = indexOf(x, y, z);
    return index == kOutside ? FoliageVoxel() : voxels_[index];
  }

  /** Of two plants in one voxel the denser one counts. Voxels outside the tiles are ignored. */
  void add(const Eigen::Array3i& voxel, Surface, double extinction);

  /** Computes around() of every empty voxel; until then it is 0. */
  void measureOpenSpace();

 private:
  static constexpr std::size_t kOutside = -1;
  static_assert(kTile == 1 << 5);

  std::int32_t tileAt(int tile_x, int tile_y) const
  {
    const int x = tile_x - first_tile_.x(), y = tile_y - first_tile_.y();
    if (x < 0 || x >= tiles_per_side_.x() || y < 0 || y >= tiles_per_side_.y()) return -1;
    return tile_at_[static_cast<std::size_t>(y * tiles_per_side_.x() + x)];
  }

  std::size_t indexOf(int x, int y, int z) const
  {
    const std::int32_t tile = tileAt(x >> 5, y >> 5);
    if (tile < 0 || z < lowest_ || z >= above()) return kOutside;
    const std::size_t layer =
        static_cast<std::size_t>(tile) * static_cast<std::size_t>(layers_) + static_cast<std::size_t>(z - lowest_);
    return (layer * kTile + static_cast<std::size_t>(y & (kTile - 1))) * kTile +
           static_cast<std::size_t>(x & (kTile - 1));
  }

  std::vector<std::uint32_t> grown(const std::vector<std::uint32_t>& rows) const;

  double voxel_size_;  // m
  std::vector<GridCell> tiles_;
  Eigen::Array2i first_tile_{0, 0}, tiles_per_side_{0, 0};
  std::vector<std::int32_t> tile_at_;  // row by row: index into tiles_, -1 where there is none
  int lowest_, layers_;                // in voxels
  std::vector<FoliageVoxel> voxels_;   // tile by tile, layer by layer, row by row
};

/** A key for the random numbers of a voxel. */
std::uint64_t keyOf(const Eigen::Array3i& voxel);
}  // namespace scanloom
