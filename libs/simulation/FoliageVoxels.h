#pragma once
#include "simulation/Lane.h"
#include "simulation/Ray.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace scanloom
{
/** What a byte says of a voxel. */
class FoliageVoxel
{
 public:
  /** Empty, and so is every voxel that differs by at most `around` in each coordinate: up to kFarthest. */
  static constexpr int kFarthest = 15;
  static FoliageVoxel empty(int around) { return FoliageVoxel(around); }

  /** `extinction` in 1/m is rounded to 0.02 and at most 2.4; less than 0.01 is empty. */
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

/** The voxels of a world, in tiles of which each reaches as low and as high as all the others. */
class FoliageVoxels
{
 public:
  static constexpr int kTile = 32;  // voxels along a horizontal edge

  /** Nothing grows yet. `tiles` are cells of kTile voxels; `lowest` and `highest` in m. */
  FoliageVoxels(double voxel_size, std::vector<GridCell> tiles, double lowest, double highest);

  double voxelSize() const { return voxel_size_; }
  int lowest() const { return lowest_; }           // in voxels
  int above() const { return lowest_ + layers_; }  // in voxels: the first that are higher than the highest
  std::size_t bytes() const { return voxels_.size(); }

  Eigen::Vector3d centreOf(const Eigen::Array3i& voxel) const { return voxel_size_ * (voxel.cast<double>() + 0.5); }
  Eigen::Array3i voxelAt(const Eigen::Vector3d& p) const { return (p.array() / voxel_size_).floor().cast<int>(); }

  /** Empty outside of the tiles. */
  FoliageVoxel at(int x, int y, int z) const
  {
    const std::size_t index = indexOf(x, y, z);
    return index == kOutside ? FoliageVoxel() : voxels_[index];
  }

  /** Where two plants grow into each other the denser one counts; what grows outside of the tiles is forgotten. */
  void add(const Eigen::Array3i& voxel, Surface, double extinction);

  /** Tells every empty voxel how empty its surroundings are; until then, none claims more than itself. */
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
  std::vector<std::int32_t> tile_at_;  // row by row: into tiles_, -1 where there is none
  int lowest_, layers_;                // in voxels
  std::vector<FoliageVoxel> voxels_;   // tile by tile, layer by layer, row by row
};

/** Of a voxel, for random numbers. */
std::uint64_t keyOf(const Eigen::Array3i& voxel);
}  // namespace scanloom
