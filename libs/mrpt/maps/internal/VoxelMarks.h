/** The voxels that the rays of one scan met, as bits, in blocks that exist only where rays passed. */
#pragma once
#include "mrpt/maps/internal/Morton.h"

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace scanloom
{
/** A cube with edges of 32 voxels; bits in the tree's order. */
struct VoxelBlock
{
  static constexpr int kLevels = 5;  // of the tree below it
  static constexpr std::size_t kVoxels = std::size_t{1} << (3 * kLevels);
  using Bits = std::array<std::uint64_t, kVoxels / 64>;

  Bits touched{};   // a ray passed or ended there
  Bits occupied{};  // a ray ended there
};

class VoxelMarks
{
 public:
  void touch(MortonCode code) { set(blockOf(code).touched, code); }
  void occupy(MortonCode code)
  {
    touch(code);
    set(latest_block_->occupied, code);
  }

  /** Adds the marks of the other. */
  void merge(VoxelMarks&& other);

  struct NumberedBlock
  {
    MortonCode number;  // the code of its voxels without their last 3 * kLevels bits
    const VoxelBlock* block;
  };
  /** In the tree's order. */
  std::vector<NumberedBlock> blocks() const;

 private:
  static void set(VoxelBlock::Bits& bits, MortonCode code)
  {
    const MortonCode place = code % VoxelBlock::kVoxels;
    bits[place / 64] |= std::uint64_t{1} << (place % 64);
  }

  VoxelBlock& blockOf(MortonCode code)
  {
    const MortonCode number = code / VoxelBlock::kVoxels;
    if (!latest_block_ || number != latest_number_)
    {
      std::unique_ptr<VoxelBlock>& block = blocks_[number];
      if (!block) block = std::make_unique<VoxelBlock>();
      latest_block_ = block.get();
      latest_number_ = number;
    }
    return *latest_block_;
  }

  std::unordered_map<MortonCode, std::unique_ptr<VoxelBlock>> blocks_;
  MortonCode latest_number_ = 0;  // of the block used last: a ray stays in a block for dozens of voxels
  VoxelBlock* latest_block_ = nullptr;
};
}  // namespace scanloom
