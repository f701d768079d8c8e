#include "mrpt/maps/internal/VoxelMarks.h"

#include <algorithm>

namespace scanloom
{
void VoxelMarks::merge(VoxelMarks&& other)
{
  latest_block_ = nullptr;
  for (auto& [number, theirs] : other.blocks_)
  {
    const auto [mine, is_new] = blocks_.try_emplace(number, nullptr);
    if (is_new)
    {
      mine->second = std::move(theirs);
      continue;
    }
    for (std::size_t i = 0; i < theirs->touched.size(); ++i)
    {
      mine->second->touched[i] |= theirs->touched[i];
      mine->second->occupied[i] |= theirs->occupied[i];
    }
  }
}

std::vector<VoxelMarks::NumberedBlock> VoxelMarks::blocks() const
{
  std::vector<NumberedBlock> sorted;
  for (const auto& [number, block] : blocks_) sorted.push_back({number, block.get()});
  std::sort(sorted.begin(), sorted.end(),
            [](const NumberedBlock& a, const NumberedBlock& b) { return a.number < b.number; });
  return sorted;
}
}  // namespace scanloom
