/** Positions that a total station or a receiver of GNSS has measured, as their programs export them. */
#pragma once
#include "base/positions/Geodetic.h"
#include "base/positions/PositionTrack.h"

#include <filesystem>
#include <optional>

namespace scanloom
{
struct PositionFile
{
  PositionTrack track;
  std::optional<Geodetic> origin;  // of GNSS: the track is east, north and up of it
};

/**
 * One measurement a line. Fields are separated by `;`, tabulators, `,` or blanks (the first of these that the first
 * line has); with other separators than `,` numbers may have a decimal comma. Comments (#) and empty lines are skipped,
 * but for a comment that is a header.
 *
 * A header names the columns, in any order and any case: t, time, stamp, timestamp; x, e, east, easting; y, n, north,
 * northing; z, h, height, elevation, up. Others are skipped. A unit may follow: `x [mm]`, `x (mm)`, `x_mm`; s, ms, us,
 * ns for the time, m, cm, mm, ft for positions. Without a header the first columns are t, x, y, z in s and m. A time
 * may also be a date, `2026-11-23T10:15:30.250Z`, with an offset such as +02:00 or in UTC.
 *
 * x, y, z must be right-handed: x is east where y is north. Instead of x and y there may be lat and lon (deg, WGS84)
 * beside the height: then positions are east, north and up of the origin, which is the first of them if none is given.
 * There may be sigma, std or accuracy: the standard deviation of each coordinate, above 0; and name, point or id: of a
 * control point at which the machine's point was.
 *
 * Throws std::invalid_argument with file and line for a header that lacks a column or has an unknown unit, for any line
 * that is none of these, and for a stamp that is not after the one before.
 */
PositionFile readPositionFile(const std::filesystem::path&, const std::optional<Geodetic>& origin = std::nullopt);
PositionTrack readTotalStation(const std::filesystem::path&);

/** Whether a reference is of a total station: .tsv, or .csv but not EuRoC's poses. Other files have poses. */
bool isTotalStation(const std::filesystem::path& reference);
}  // namespace scanloom
