/** The target cells that each source cell is compared with. */
#pragma once
#include "base/core/Array.h"
#include "base/core/Rigid.h"
#include "estimation/ndt/NdtMap.h"
#include "estimation/ndt/internal/ScoreSums.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
/**
 * For each source cell the Gaussians among the 1, 7 or 27 target cells around its mean. 27 cells reach one to two
 * target edges beyond the mean: enough for source cells of up to 2.5 target edges; of larger ones they cover a part.
 *
 * Source cells come in chunks of a fixed size, so that sums over them do not depend on the number of threads. Different
 * threads may use different chunks at a time. Keeps references to target and source.
 */
class CellCorrespondences
{
 public:
  static constexpr std::size_t kChunk = 256;  // source cells

  /** Throws std::invalid_argument unless `neighbours` is 1, 7 or 27. */
  CellCorrespondences(const NdtMap& target, const NdtMap& source, int neighbours)
    : CellCorrespondences(target, source.cells(), source.options().cell_size, neighbours)
  {
  }
  CellCorrespondences(const NdtMap& target, const std::vector<GaussianCell>& source, double source_edge,
                      int neighbours);

  std::size_t chunks() const { return chunks_.size(); }

  /** All chunks, in parallel. */
  void moveTo(const Rigid& target_T_source);

  /** Looks neighbours up again only for means that have moved to another target cell. */
  void moveTo(const Rigid& target_T_source, std::size_t chunk);

  /**
   * From now on only cells count that both maps have at this pose: source cells whose mean lies in a cube with a target
   * cell, and target cells whose cube holds the mean of a source cell. Cells that one map alone has seen would pull at
   * their neighbours in the other: they lie to one side of what both have seen, farther out or back along the way.
   */
  void keepCommon(const Rigid& target_T_source);

  /** A chunk's source cells in the target's frame, and the target cells of each. */
  struct Chunk
  {
    std::size_t first = 0;           // index of its first source cell
    std::vector<TurnedCell> cells;   // as moved by moveTo()
    std::vector<BlockRange> ranges;  // of each, into `blocks`
    Array<TargetBlock> blocks;
    std::vector<std::uint32_t> found;  // room for all neighbours of each source cell
    std::vector<std::uint32_t> counts;
    std::vector<Eigen::Vector3i> centres;  // target cells whose neighbours were last looked up

    PairBatch pairs() const { return {cells.data(), ranges.data(), cells.size(), blocks.data()}; }
  };
  const Chunk& chunk(std::size_t i) const { return chunks_[i]; }

  struct Range
  {
    const std::uint32_t* first;
    const std::uint32_t* last;
    const std::uint32_t* begin() const { return first; }
    const std::uint32_t* end() const { return last; }
  };
  /** Indices into target(). */
  Range of(std::size_t source_cell) const
  {
    const Chunk& chunk = chunks_[source_cell / kChunk];
    const std::size_t i = source_cell % kChunk;
    const std::uint32_t* first = chunk.found.data() + i * static_cast<std::size_t>(neighbours_);
    return {first, first + chunk.counts[i]};
  }

  const NdtMap& targetMap() const { return target_; }
  const std::vector<GaussianCell>& target() const { return target_.cells(); }
  const std::vector<GaussianCell>& source() const { return source_; }
  double sourceEdge() const { return source_edge_; }
  int neighbours() const { return neighbours_; }

 private:
  void lookUp(std::size_t chunk, std::size_t i, const Eigen::Vector3i& centre);
  std::size_t findAround(const Eigen::Vector3i& centre, std::uint32_t* found) const;

  const NdtMap& target_;
  const std::vector<GaussianCell>& source_;
  double source_edge_;
  int neighbours_;
  std::vector<Chunk> chunks_;
  std::vector<char> is_common_;  // by target cell; empty: all count
};
}  // namespace scanloom
