/** Estimates that a few wild values do not move. */
#pragma once
#include <vector>

namespace scanloom
{
/** Linear between neighbours; `share` in [0, 1]. Throws std::invalid_argument for no values. */
double quantileOfSorted(const std::vector<double>& sorted, double share);
double median(std::vector<double> values);

/** 1.4826 times the median distance from the median: of a normal distribution its standard deviation. */
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
 * The median of the slopes of all pairs (P. K. Sen, 1968): up to 29 % of the samples may be wild. `least_scatter` is
 * what the scatter about the line is at least. Throws std::invalid_argument for fewer than two different x.
 */
RobustLine theilSen(const std::vector<Sample2d>&, double least_scatter);
}  // namespace scanloom
