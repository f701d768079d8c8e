#include "estimation/ndt/CellCorrespondences.h"

#include "base/core/forAll.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace scanloom
{
namespace
{
TurnedCell turnedCell(const GaussianCell& cell, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation)
{
  const Eigen::Vector3d mean = rotation * cell.mean + translation;
  const Eigen::Matrix3d half = rotation * cell.covariance;
  const auto entry = [&](int i, int j) { return half.row(i).dot(rotation.row(j)); };
  return {mean.x(), mean.y(), mean.z(), entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

/** No cell of any map. */
Eigen::Vector3i noCentre() { return Eigen::Vector3i::Constant(std::numeric_limits<int>::min()); }

GaussianCell nowhere()
{
  const double far = 1e9;  // m
  return {Eigen::Vector3d::Constant(far), Eigen::Matrix3d::Identity()};
}
}  // namespace

CellCorrespondences::CellCorrespondences(const NdtMap& target, const std::vector<GaussianCell>& source,
                                         double source_edge, int neighbours)
  : target_(target), source_(source), source_edge_(source_edge), neighbours_(neighbours)
{
  if (neighbours != 1 && neighbours != 7 && neighbours != 27)
    throw std::invalid_argument(fmt::format("RegistrationOptions: neighbours = {}: must be 1, 7 or 27", neighbours));
  const std::size_t cells = source.size();
  for (std::size_t first = 0; first < cells; first += kChunk)
  {
    const std::size_t count = std::min(kChunk, cells - first);
    Chunk chunk;
    chunk.first = first;
    chunk.cells.resize(count);
    chunk.ranges.assign(count, {0, 0});
    chunk.blocks.reserve(count *
                         ((static_cast<std::size_t>(neighbours) + TargetBlock::kLanes - 1) / TargetBlock::kLanes));
    chunk.found.resize(count * static_cast<std::size_t>(neighbours));
    chunk.counts.assign(count, 0);
    chunk.centres.assign(count, noCentre());
    chunks_.push_back(std::move(chunk));
  }
}

void CellCorrespondences::keepCommon(const Rigid& target_T_source)
{
  const std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> own(source_.size(), none);
  forAll(own.size(), 256,
         [&](std::size_t i) { target_.findAround(target_.indexOf(target_T_source * source_[i].mean), 1, &own[i]); });
  is_common_.assign(target().size(), 0);
  for (const std::uint32_t cell : own)
    if (cell != none) is_common_[cell] = 1;
  for (Chunk& chunk : chunks_) std::fill(chunk.centres.begin(), chunk.centres.end(), noCentre());
}

/** Writes the cells that count to `found`, which has room for all. */
std::size_t CellCorrespondences::findAround(const Eigen::Vector3i& centre, std::uint32_t* found) const
{
  if (std::uint32_t own = 0; !is_common_.empty() && target_.findAround(centre, 1, &own) == 0) return 0;
  const std::size_t count = target_.findAround(centre, neighbours_, found);
  if (is_common_.empty()) return count;
  const auto end = std::remove_if(found, found + count, [&](std::uint32_t cell) { return is_common_[cell] == 0; });
  return static_cast<std::size_t>(end - found);
}

void CellCorrespondences::moveTo(const Rigid& target_T_source)
{
  tbb::parallel_for(std::size_t{0}, chunks_.size(), [&](std::size_t i) { moveTo(target_T_source, i); });
}

void CellCorrespondences::moveTo(const Rigid& target_T_source, std::size_t index)
{
  Chunk& chunk = chunks_[index];
  const Eigen::Matrix3d rotation = target_T_source.rotation.toRotationMatrix();
  for (std::size_t i = 0; i < chunk.cells.size(); ++i)
  {
    TurnedCell& cell = chunk.cells[i];
    cell = turnedCell(source_[chunk.first + i], rotation, target_T_source.translation);
    const Eigen::Vector3i centre = target_.indexOf({cell.x, cell.y, cell.z});
    if (centre != chunk.centres[i]) lookUp(index, i, centre);
  }
}

/** Blocks that are too few for the new neighbours stay behind unused; that is rare within a registration. */
void CellCorrespondences::lookUp(std::size_t index, std::size_t i, const Eigen::Vector3i& centre)
{
  Chunk& chunk = chunks_[index];
  std::uint32_t* found = chunk.found.data() + i * static_cast<std::size_t>(neighbours_);
  const std::size_t count = findAround(centre, found);
  chunk.centres[i] = centre;
  chunk.counts[i] = static_cast<std::uint32_t>(count);

  // The cells that are copied below are scattered over the map's megabytes, so all are fetched at once.
  for (std::size_t k = 0; k < count; ++k)
  {
    const GaussianCell& cell = target_.cells()[found[k]];
    __builtin_prefetch(&cell.mean);
    __builtin_prefetch(&cell.covariance(2, 2));
  }
  const auto blocks = static_cast<std::uint32_t>((count + TargetBlock::kLanes - 1) / TargetBlock::kLanes);
  BlockRange& range = chunk.ranges[i];
  if (blocks > range.count)
  {
    range.first = static_cast<std::uint32_t>(chunk.blocks.size());
    chunk.blocks.room(blocks);  // written below
    chunk.blocks.grow(blocks);
  }
  range.count = blocks;
  static const GaussianCell kNowhere = nowhere();
  for (std::size_t k = 0; k < blocks * TargetBlock::kLanes; ++k)
  {
    const GaussianCell& cell = k < count ? target_.cells()[found[k]] : kNowhere;
    chunk.blocks[range.first + k / TargetBlock::kLanes].set(k % TargetBlock::kLanes, cell.mean, cell.covariance);
  }
}
}  // namespace scanloom
