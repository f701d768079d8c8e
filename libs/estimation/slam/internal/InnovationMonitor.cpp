#include "estimation/slam/internal/InnovationMonitor.h"

#include "base/core/Statistics.h"

#include <vector>

namespace scanloom
{
namespace
{
constexpr Duration kWindow = 10s;
}  // namespace

void InnovationMonitor::add(Timestamp stamp, double mahalanobis)
{
  last_.emplace_back(stamp, mahalanobis);
  while (stamp - last_[1 % last_.size()].first >= kWindow) last_.pop_front();
}

double InnovationMonitor::median() const
{
  if (last_.size() < 5 || last_.back().first - last_.front().first < kWindow) return 0;
  std::vector<double> distances;
  for (const auto& [stamp, mahalanobis] : last_) distances.push_back(mahalanobis);
  return upperMedian(std::move(distances));
}
}  // namespace scanloom
