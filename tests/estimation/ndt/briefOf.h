#pragma once
#include "estimation/ndt/Registration.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace scanloom
{
/** In one line, for messages. */
inline std::string briefOf(const RegistrationResult& r)
{
  const Eigen::Vector3d& t = r.target_T_source.translation;
  const Eigen::Vector3d degrees = r.target_T_source.yawPitchRoll() * 180 / M_PI;
  const auto deviation = [&r](int first) { return std::sqrt(r.covariance.block<3, 3>(first, first).trace()); };
  return fmt::format(
      "{}{}: ({:.3f} {:.3f} {:.3f}) m, yaw pitch roll ({:.3f} {:.3f} {:.3f}) deg, +- {:.3f} m {:.3f} deg, "
      "overlap {:.0f} %, score {:.2f}, {} iterations",
      toString(r.outcome),
      r.degenerate_directions.empty() ? std::string()
                                      : fmt::format(" in {} directions", r.degenerate_directions.size()),
      t.x(), t.y(), t.z(), degrees[0], degrees[1], degrees[2], deviation(0), deviation(3) * 180 / M_PI, 100 * r.overlap,
      r.score, r.iterations);
}
}  // namespace scanloom
