/** A few of many. */
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace scanloom
{
/** At most `most`, evenly chosen, in their order. */
template <typename T>
std::vector<T> someOf(const std::vector<T>& all, std::size_t most)
{
  const std::size_t count = std::min(most, all.size());
  std::vector<T> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(all[i * all.size() / count]);
  return some;
}
}  // namespace scanloom
