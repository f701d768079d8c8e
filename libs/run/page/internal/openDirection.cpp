#include "run/page/internal/openDirection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace scanloom
{
namespace
{
// Share of a direction in what is open, above which it is named. Of a line between two axes each has a half.
constexpr double kNamed = 0.6;

/** Of the horizontal directions: both axes, one of them, or the line between them. */
std::vector<std::string> openInThePlane(const Matrix6d& open)
{
  std::vector<std::string> names;
  if (open(0, 0) > kNamed) names.emplace_back("ahead");
  if (open(1, 1) > kNamed) names.emplace_back("sideways");
  if (names.empty() && open(0, 0) + open(1, 1) > kNamed)
    names.emplace_back(open(0, 1) > 0 ? "ahead to the left" : "ahead to the right");
  return names;
}
}  // namespace

std::string openDirection(const StateEstimate& estimate)
{
  if (!estimate.registration) return "no points to register";
  const RegistrationResult& registration = *estimate.registration;
  // The directions may be any basis of what is open; their projection is not.
  Matrix6d open = Matrix6d::Zero();
  for (const Vector6d& direction : registration.degenerate_directions) open += direction * direction.transpose();
  std::vector<std::string> names = openInThePlane(open);
  if (open(2, 2) > kNamed) names.emplace_back("upwards");
  if (open(5, 5) > kNamed) names.emplace_back("in heading");
  if (open(3, 3) + open(4, 4) > kNamed) names.emplace_back("in tilt");
  if (!names.empty()) return fmt::format("open {}", fmt::join(names, ", "));
  if (!registration.degenerate_directions.empty()) return "open in a mixed direction";
  if (registration.outcome == Outcome::LowOverlap) return "little in view is known";
  return estimate.trusted ? "lidars and IMU are apart" : "the scan contradicts the IMU";
}
}  // namespace scanloom
