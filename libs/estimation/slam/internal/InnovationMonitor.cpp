#include "estimation/slam/internal/InnovationMonitor.h"

#include "base/core/Statistics.h"

#include <vector>

namespace scanloom
{
namespace
{
constexpr Duration kWindow = 10s;
}  // namespace

void InnovationMonitor::add(Timestamp stamp, double surprise)
{
  last_.emplace_back(stamp, surprise);
  while (stamp - last_[1 % last_.size()].first >= kWindow) last_.pop_front();
}

double InnovationMonitor::median() const
{
  if (last_.size() < 5 || last_.back().first - last_.front().first < kWindow) return 0;
  std::vector<double> surprises;
  for (const auto& [stamp, surprise] : last_) surprises.push_back(surprise);
  return upperMedian(std::move(surprises));
}
}  // namespace scanloom
