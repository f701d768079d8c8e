/** Statistics that a few outliers do not change. */
#pragma once
#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace scanloom
{
/** Linear between neighbours; `share` in [0, 1]. Throws std::invalid_argument for no values, as all do here. */
double quantileOfSorted(const std::vector<double>& sorted, double share);

/** The mean of the two middle ones of an even number of values. */
double median(std::vector<double> values);

/** The larger of the two middle ones of an even number of values: always one of them, whatever their type. */
template <typename Value>
Value upperMedian(std::vector<Value> values)
{
  if (values.empty()) throw std::invalid_argument("upperMedian: no values");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** 1.4826 times the median distance from the median: the standard deviation, for a normal distribution. */
double robustDeviation(const std::vector<double>& values);

struct Sample2d
{
  double x = 0, y = 0;
};

struct RobustLine
{
  double slope = 0, intercept = 0;  // y = intercept + slope x
  double slope_sigma = 0;           // standard deviation, from the scatter about the line
};

/**
 * The median of the slopes of all pairs (P. K. Sen, 1968): up to 29 % of the samples may be outliers. The
 * scatter about the line is taken as `least_scatter` if it is smaller. Throws std::invalid_argument for fewer than two
 * different x.
 */
RobustLine theilSen(const std::vector<Sample2d>&, double least_scatter);
}  // namespace scanloom
