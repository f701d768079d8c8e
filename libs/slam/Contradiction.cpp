#include "slam/Contradiction.h"

#include <algorithm>
#include <vector>

namespace scanloom
{
namespace
{
constexpr Duration kWindow = 10s;
constexpr std::size_t kFewest = 5;

double medianOf(const std::deque<std::pair<Timestamp, double>>& last)
{
  if (last.size() < kFewest || last.back().first - last.front().first < kWindow) return 0;
  std::vector<double> surprises;
  for (const auto& [stamp, surprise] : last) surprises.push_back(surprise);
  const auto middle = surprises.begin() + static_cast<std::ptrdiff_t>(surprises.size() / 2);
  std::nth_element(surprises.begin(), middle, surprises.end());
  return *middle;
}
}  // namespace

void Contradiction::add(Timestamp stamp, double surprise)
{
  last_.emplace_back(stamp, surprise);
  while (stamp - last_[1 % last_.size()].first >= kWindow) last_.pop_front();
  median_ = medianOf(last_);
}
}  // namespace scanloom
