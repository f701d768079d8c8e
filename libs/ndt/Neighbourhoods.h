/** Which target cells each source cell is compared with. */
#pragma once
#include "core/Rigid.h"
#include "ndt/NdtMap.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
/**
 * For each source cell the Gaussians among the 1, 7 or 27 target cells at its mean. With 27 the mean lies one to two
 * target edges inside the block, so that a source cell of up to 2.5 target edges meets what its own points can touch;
 * larger ratios still work, but see less and less of their own extent.
 *
 * Keeps references to both maps.
 */
class Neighbourhoods
{
 public:
  /** Throws std::invalid_argument unless `neighbours` is 1, 7 or 27. */
  Neighbourhoods(const NdtMap& target, const NdtMap& source, int neighbours);

  /** Looks the neighbours up again where a mean has changed its cell. */
  void moveTo(const Rigid& target_T_source);

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
    const std::uint32_t* first = found_.data() + source_cell * offsets_.size();
    return {first, first + counts_[source_cell]};
  }

  const std::vector<GaussianCell>& target() const { return target_.cells(); }
  const std::vector<GaussianCell>& source() const { return source_.cells(); }
  double targetEdge() const { return target_.options().cell_size; }
  double sourceEdge() const { return source_.options().cell_size; }

 private:
  const NdtMap& target_;
  const NdtMap& source_;
  std::vector<Eigen::Vector3i> offsets_;
  std::vector<Eigen::Vector3i> centres_;  // where the neighbours of each source cell were last looked up
  std::vector<std::uint32_t> found_;      // offsets_.size() places per source cell
  std::vector<std::uint32_t> counts_;
};
}  // namespace scanloom
