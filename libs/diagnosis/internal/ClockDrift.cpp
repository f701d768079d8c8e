#include "diagnosis/internal/ClockDrift.h"

#include "base/core/Statistics.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr int kWindows = 30;
constexpr Duration kShortestWindow = 250ms;  // enough packets that one of them arrives without delay
constexpr int kFewestMinima = 8;
constexpr double kArrivalResolution = 1e-6;  // s, of arrival stamps in ordinary captures

std::vector<Sample2d> leastDelays(const std::vector<Arrival>& arrivals)
{
  const Timestamp first = arrivals.front().received, last = arrivals.back().received;
  const Duration window = std::max(kShortestWindow, (last - first) / kWindows + 1ns);
  const Duration base = arrivals.front().delay();
  std::vector<Sample2d> minima;
  std::int64_t current = -1;
  for (const Arrival& arrival : arrivals)
  {
    const std::int64_t index = (arrival.received - first) / window;
    const Sample2d here{seconds(arrival.received - first), seconds(arrival.delay() - base)};
    if (index > current)
    {
      current = index;
      minima.push_back(here);
    }
    else if (here.y < minima.back().y)
      minima.back() = here;
  }
  return minima;
}

/** Delays above the smallest one, in s, sorted. */
std::vector<double> jitters(const std::vector<Arrival>& arrivals, const std::optional<ClockDrift>& drift)
{
  const double slope = drift ? -1e-6 * drift->ppm : 0;
  std::vector<double> values;
  for (const Arrival& arrival : arrivals)
    values.push_back(seconds(arrival.delay() - arrivals.front().delay()) -
                     slope * seconds(arrival.received - arrivals.front().received));
  std::sort(values.begin(), values.end());
  const double least = values.front();
  for (double& value : values) value -= least;
  return values;
}
}  // namespace

std::optional<ClockDrift> clockDrift(const std::vector<Arrival>& arrivals, Duration shortest)
{
  if (arrivals.empty() || arrivals.back().received - arrivals.front().received < shortest) return std::nullopt;
  const std::vector<Sample2d> minima = leastDelays(arrivals);
  if (minima.size() < kFewestMinima) return std::nullopt;
  const RobustLine line = theilSen(minima, kArrivalResolution);
  return ClockDrift{-1e6 * line.slope, 1e6 * line.slope_sigma};
}

ClockDrift operator-(const ClockDrift& a, const ClockDrift& b)
{
  return {a.ppm - b.ppm, std::hypot(a.sigma_ppm, b.sigma_ppm)};
}

std::optional<ArrivalJitter> arrivalJitter(const std::vector<Arrival>& arrivals, const std::optional<ClockDrift>& drift,
                                           Duration deadline)
{
  if (arrivals.empty()) return std::nullopt;
  const std::vector<double> sorted = jitters(arrivals, drift);
  ArrivalJitter jitter;
  jitter.p50 = fromSeconds(quantileOfSorted(sorted, 0.5));
  jitter.p99 = fromSeconds(quantileOfSorted(sorted, 0.99));
  jitter.largest = fromSeconds(sorted.back());
  const auto late = sorted.end() - std::upper_bound(sorted.begin(), sorted.end(), seconds(deadline));
  jitter.late_share = static_cast<double>(late) / static_cast<double>(sorted.size());
  return jitter;
}
}  // namespace scanloom
