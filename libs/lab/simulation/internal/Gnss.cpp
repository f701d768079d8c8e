#include "lab/simulation/internal/Gnss.h"

#include "base/core/Angle.h"
#include "lab/simulation/internal/Random.h"

#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kLasting = 30;      // s: time constant of the error, a Gauss-Markov process (assumed)
constexpr double kOutlierSize = 10;  // times the error (assumed)

Eigen::Vector3d normal(Random& random)
{
  const double x = random.normal(), y = random.normal();
  return {x, y, random.normal()};
}

/** The inverse of eastNorthUp(), by steps on a sphere. */
Geodetic geodeticAt(const Eigen::Vector3d& enu, const Geodetic& origin)
{
  constexpr double kEarth = 6.371e6;  // m
  Geodetic at = origin;
  for (int step = 0; step < 6; ++step)
  {
    const Eigen::Vector3d off = enu - eastNorthUp(at, origin);
    at.latitude += off.y() / kEarth / kDegree;
    at.longitude += off.x() / (kEarth * std::cos(at.latitude * kDegree)) / kDegree;
    at.height += off.z();
  }
  return at;
}
}  // namespace

const Rigid& enuTWorld()
{
  static const Rigid enu_T_world = Rigid::fromXyzYawPitchRoll(120, -340, 15, 23.7 * kDegree, 0, 0);
  return enu_T_world;
}

Geodetic gnssOrigin() { return {62.2417, 25.7473, 141.5}; }

std::vector<GnssFix> gnssFixes(const Drive& drive, const RecordingSpan& span, const GnssOptions& options,
                               const Eigen::Vector3d& body_p_antenna, std::uint64_t seed)
{
  std::vector<GnssFix> fixes;
  if (options.error == 0) return fixes;
  const double kept = std::exp(-1 / kLasting);
  Eigen::Vector3d error = Eigen::Vector3d::Zero();
  for (std::uint64_t n = 0; static_cast<double>(n) <= span.duration; ++n)
  {
    Random random(seed, RandomStream::Gnss, n);
    const double share = n == 0 ? 1 : std::sqrt(1 - kept * kept);
    error = kept * error + share * options.error * normal(random);
    const bool is_outlier = random.uniform() < options.outliers;
    const Eigen::Vector3d outlier = kOutlierSize * options.error * normal(random);
    const auto t = static_cast<double>(n);
    const Eigen::Vector3d antenna = enuTWorld() * (drive.at(t).world_T_body * body_p_antenna);
    fixes.push_back({span.start + fromSeconds(t),
                     geodeticAt(antenna + error + (is_outlier ? outlier : Eigen::Vector3d::Zero()), gnssOrigin())});
  }
  return fixes;
}
}  // namespace scanloom
