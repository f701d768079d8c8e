#pragma once
#include "base/positions/TotalStation.h"

#include <filesystem>
#include <optional>

namespace scanloom
{
/**
 * Fixes of a rawlog's CObservationGPS with an NMEA GGA sentence, as rawlog-grabber records them: east, north and up of
 * the origin, which is the first of them if none is given. Their standard deviation is by the kind of the fix: 0.02 m
 * fixed RTK, 0.5 m float, 1 m differential, 2 m any other. Without a fix, or not after the one before: left out. Throws
 * std::invalid_argument if there are none, and what ObservationReader throws.
 */
PositionFile readGnssOfRawlog(const std::filesystem::path&, const std::optional<Geodetic>& origin = std::nullopt);
}  // namespace scanloom
