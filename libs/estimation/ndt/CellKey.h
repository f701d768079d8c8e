/** Cells of a grid as 64 bit keys. Blocks of four by four by four cells have consecutive keys. */
#pragma once
#include <Eigen/Core>

#include <cstdint>

namespace scanloom
{
/**
 * Keys sort by block (z, y, x) and within it by cell (z, y, x). The 27 cells around a cell lie in at most eight blocks,
 * in three or four on average, so finding them takes that many look-ups instead of 27.
 */
struct CellKey
{
  static constexpr int kBitsPerAxis = 21;
  static constexpr std::int64_t kLimit = std::int64_t{1} << (kBitsPerAxis - 1);  // indices are in [-kLimit, kLimit)
  static constexpr int kCellBits = 6;                                            // for the 64 cells of a block

  static bool fits(std::int64_t index) { return index >= -kLimit && index < kLimit; }

  static std::uint64_t of(std::int64_t x, std::int64_t y, std::int64_t z)
  {
    std::uint64_t key;
    compose(biased(x), biased(y), biased(z), key);
    return key;
  }

  /** From biased indices of one cell, or of a vector of cells (which no ABI returns alike on every processor). */
  template <typename Bits>
  static void compose(const Bits& x, const Bits& y, const Bits& z, Bits& key)
  {
    key = ((z >> 2) << (2 * kBlockBits) | (y >> 2) << kBlockBits | x >> 2) << kCellBits |  //
          (z & 3) << 4 | (y & 3) << 2 | (x & 3);
  }

  static std::uint64_t blockOf(std::uint64_t x, std::uint64_t y, std::uint64_t z)
  {
    return z << (2 * kBlockBits) | y << kBlockBits | x;
  }

  static Eigen::Matrix<std::int64_t, 3, 1> indexOf(std::uint64_t key)
  {
    const std::uint64_t block = key >> kCellBits;
    const auto axis = [](std::uint64_t of_block, std::uint64_t in_block)
    { return static_cast<std::int64_t>((of_block & kBlockMask) << 2 | (in_block & 3)) - kLimit; };
    return {axis(block, key), axis(block >> kBlockBits, key >> 2), axis(block >> (2 * kBlockBits), key >> 4)};
  }

  /** An index from 0 on. */
  static std::uint64_t biased(std::int64_t index) { return static_cast<std::uint64_t>(index + kLimit); }

 private:
  static constexpr int kBlockBits = kBitsPerAxis - 2;
  static constexpr std::uint64_t kBlockMask = (std::uint64_t{1} << kBlockBits) - 1;
};

struct KeyHash
{
  std::size_t operator()(std::uint64_t key) const
  {
    return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15u) >> 24);
  }
};
}  // namespace scanloom
