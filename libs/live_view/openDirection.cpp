#include "live_view/openDirection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <set>

namespace scanloom
{
std::string openDirection(const StateEstimate& estimate)
{
  if (!estimate.registration) return "no points to register";
  const RegistrationResult& registration = *estimate.registration;
  constexpr std::array kNames{"ahead", "sideways", "upwards", "in tilt", "in tilt", "in heading"};
  std::set<std::string> open;
  for (const Vector6d& direction : registration.degenerate_directions)
  {
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    open.insert(kNames[static_cast<std::size_t>(largest)]);
  }
  if (!open.empty()) return fmt::format("open {}", fmt::join(open, ", "));
  if (registration.outcome == Outcome::LowOverlap) return "little in view is known";
  return estimate.trusted ? "lidars and IMU are apart" : "the scan contradicts the IMU";
}
}  // namespace scanloom
