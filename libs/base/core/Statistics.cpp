#include "base/core/Statistics.h"

#include <cmath>

namespace scanloom
{
double quantileOfSorted(const std::vector<double>& sorted, double share)
{
  if (sorted.empty()) throw std::invalid_argument("quantileOfSorted: no values");
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return quantileOfSorted(values, 0.5);
}

double robustDeviation(const std::vector<double>& values)
{
  const double middle = median(values);
  std::vector<double> distances;
  for (const double value : values) distances.push_back(std::abs(value - middle));
  return 1.4826 * median(std::move(distances));
}

RobustLine theilSen(const std::vector<Sample2d>& samples, double least_scatter)
{
  std::vector<double> slopes;
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (samples[i].x != samples[j].x) slopes.push_back((samples[i].y - samples[j].y) / (samples[i].x - samples[j].x));
  if (slopes.empty()) throw std::invalid_argument("theilSen: needs two different x");

  RobustLine line;
  line.slope = median(std::move(slopes));
  std::vector<double> intercepts;
  double mean_x = 0;
  for (const Sample2d& s : samples)
  {
    intercepts.push_back(s.y - line.slope * s.x);
    mean_x += s.x / static_cast<double>(samples.size());
  }
  line.intercept = median(intercepts);

  double spread = 0;
  for (const Sample2d& s : samples) spread += (s.x - mean_x) * (s.x - mean_x);
  line.slope_sigma = std::max(least_scatter, robustDeviation(intercepts)) / std::sqrt(spread);
  return line;
}
}  // namespace scanloom
