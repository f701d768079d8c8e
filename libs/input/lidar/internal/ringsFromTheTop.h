#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace scanloom
{
/** The ring of each channel: 0 is the topmost beam. Channels of most lidars count or fire in an order of their own. */
inline std::vector<std::uint8_t> ringsFromTheTop(const std::vector<double>& vertical_deg)
{
  std::vector<std::size_t> from_the_top(vertical_deg.size());
  std::iota(from_the_top.begin(), from_the_top.end(), 0);
  std::stable_sort(from_the_top.begin(), from_the_top.end(),
                   [&](std::size_t a, std::size_t b) { return vertical_deg[a] > vertical_deg[b]; });
  std::vector<std::uint8_t> rings(vertical_deg.size());
  for (std::size_t place = 0; place < rings.size(); ++place)
    rings[from_the_top[place]] = static_cast<std::uint8_t>(place);
  return rings;
}
}  // namespace scanloom
