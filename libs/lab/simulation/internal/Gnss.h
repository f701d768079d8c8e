/** A receiver of GNSS on the machine, without corrections, under a canopy. */
#pragma once
#include "base/core/Field.h"
#include "base/positions/Geodetic.h"
#include "lab/simulation/internal/Drive.h"
#include "lab/simulation/internal/SimulatedImu.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
struct GnssOptions
{
  double error = 0;
  double outliers = 0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.error, Field{"error", "m",
                         "standard deviation of each coordinate, which lasts for about 30 s as leaves reflect "
                         "(assumed); 0: there is no receiver",
                         between(0, 100)});
    visit(o.outliers, Field{"outliers", "", "share of the fixes that are off by ten times as much", between(0, 1)});
  }
};

struct GnssFix
{
  Timestamp stamp;
  Geodetic at;
};

/** East, north and up of gnssOrigin() from the world frame. */
const Rigid& enuTWorld();
Geodetic gnssOrigin();

/** A fix a second, of a point on the body. */
std::vector<GnssFix> gnssFixes(const Drive&, const RecordingSpan&, const GnssOptions&,
                               const Eigen::Vector3d& body_p_antenna, std::uint64_t seed);
}  // namespace scanloom
