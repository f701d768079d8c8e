#include "site/GnssOfRawlog.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/observations/ObservationReader.h"

#include <fmt/format.h>
#include <mrpt/obs/CObservationGPS.h>

#include <stdexcept>

namespace scanloom
{
namespace
{
using mrpt::obs::gnss::Message_NMEA_GGA;

/** m, of fields' `fix_quality`: NMEA 0183, sentence GGA, field 6. Of receivers in the open; HDOP says no more. */
double sigmaOf(int quality)
{
  constexpr int kDifferential = 2, kFixedRtk = 4, kFloatRtk = 5;
  return quality == kFixedRtk ? 0.02 : quality == kFloatRtk ? 0.5 : quality == kDifferential ? 1 : 2;
}
}  // namespace

PositionFile readGnssOfRawlog(const std::filesystem::path& path, const std::optional<Geodetic>& origin)
{
  PositionFile positions{{}, origin};
  ObservationReader reader(path);
  while (const mrpt::obs::CObservation::Ptr observation = reader.next())
  {
    const auto gps = std::dynamic_pointer_cast<mrpt::obs::CObservationGPS>(observation);
    if (!gps || !gps->hasMsgClass<Message_NMEA_GGA>()) continue;
    const auto& fix = gps->getMsgByClass<Message_NMEA_GGA>().fields;
    const Timestamp stamp = fromMrpt(gps->timestamp);
    if (fix.fix_quality == 0 || (!positions.track.empty() && stamp <= positions.track.back().stamp)) continue;
    // GGA has heights above the geoid, and the geoid's above the ellipsoid.
    const Geodetic at{fix.latitude_degrees, fix.longitude_degrees, fix.altitude_meters + fix.geoidal_distance};
    if (!positions.origin) positions.origin = at;
    positions.track.push_back({stamp, eastNorthUp(at, *positions.origin), sigmaOf(fix.fix_quality)});
  }
  if (positions.track.empty())
    throw std::invalid_argument(fmt::format("{}: holds no CObservationGPS with a fix (NMEA GGA)", path.string()));
  return positions;
}
}  // namespace scanloom
