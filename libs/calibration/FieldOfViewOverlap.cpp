#include "calibration/FieldOfViewOverlap.h"

#include "base/core/Angle.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr std::size_t kDirections = 36;
using Directions = std::bitset<kDirections>;

/** In which the view, in the body's frame, has more than a stray point. */
Directions directionsOf(const View& view)
{
  constexpr int kFewestPoints = 10;
  std::array<int, kDirections> points{};
  for (const Eigen::Vector3f& p : view.points)
  {
    const double turns = std::atan2(p.y(), p.x()) / (2 * M_PI) + 0.5;
    ++points[std::min(kDirections - 1, static_cast<std::size_t>(turns * kDirections))];
  }
  Directions seen;
  for (std::size_t i = 0; i < kDirections; ++i) seen[i] = points[i] >= kFewestPoints;
  return seen;
}
}  // namespace

double commonField(const std::vector<Station>& stations, const Extrinsics& extrinsics, const Trajectory& trajectory)
{
  double sum = 0, count = 0;
  for (const Station& station : stations)
  {
    if (station.reference.empty() || station.scans.empty()) continue;
    const std::optional<View> view = viewFrom(*station.scans.front(), extrinsics, trajectory, station.at);
    if (!view) continue;
    const Directions a = directionsOf(*view), b = directionsOf(station.reference.front());
    sum += static_cast<double>((a & b).count()) / std::max<double>(1, (a | b).count());
    ++count;
  }
  return count > 0 ? sum / count : 0;
}
}  // namespace scanloom
