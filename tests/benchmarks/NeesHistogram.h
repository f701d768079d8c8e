/** Squared errors by the covariances that came with them, beside chi squared: what consistent estimates would show. */
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace scanloom
{
/** Of the sum of so many squares of independent standard normal numbers: 2, 3 or 6. */
inline double chiSquaredBelow(double x, int freedom)
{
  switch (freedom)
  {
    case 2:
      return 1 - std::exp(-x / 2);
    case 3:
      return std::erf(std::sqrt(x / 2)) - std::sqrt(2 * x / M_PI) * std::exp(-x / 2);
    case 6:
      return 1 - std::exp(-x / 2) * (1 + x / 2 + x * x / 8);
    default:
      throw std::invalid_argument("chiSquaredBelow: 2, 3 or 6 degrees of freedom");
  }
}

inline void printHistogram(const std::vector<double>& nees, int freedom)
{
  constexpr std::array kEdges{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0, 1e9};
  fmt::print("\n| NEES | share | of chi squared, {} | |\n|---|--:|--:|---|\n", freedom);
  for (std::size_t i = 0; i + 1 < kEdges.size(); ++i)
  {
    const auto in = [&](double v) { return v >= kEdges[i] && v < kEdges[i + 1]; };
    const double share =
        static_cast<double>(std::count_if(nees.begin(), nees.end(), in)) / static_cast<double>(nees.size());
    const double expected = chiSquaredBelow(kEdges[i + 1], freedom) - chiSquaredBelow(kEdges[i], freedom);
    fmt::print(
        "| {} | {:.0f} % | {:.0f} % | {} |\n",
        kEdges[i + 1] < 1e9 ? fmt::format("{} to {}", kEdges[i], kEdges[i + 1]) : fmt::format("from {}", kEdges[i]),
        100 * share, 100 * expected, std::string(static_cast<std::size_t>(100 * share / 2 + 0.5), '#'));
  }
}
}  // namespace scanloom
