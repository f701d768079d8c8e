/** What the columns of a total station's file hold. */
#pragma once
#include "base/core/Time.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct StationColumns
{
  std::size_t stamp = 0;
  std::array<std::size_t, 3> position{1, 2, 3};
  Duration stamp_unit = 1s;
  std::array<double, 3> position_unit{1, 1, 1};  // m; latitude and longitude: deg
  bool geodetic = false;                         // latitude, longitude, height instead of x, y, z
  std::optional<std::size_t> sigma, name;
  double sigma_unit = 1;  // m

  /** Throws std::invalid_argument with what is missing, given twice, or of an unknown unit. */
  static StationColumns ofHeader(const std::vector<std::string>& names);
};

/** `12.5` (in `unit`), or `2026-11-23T10:15:30.250Z`. Nothing if the text is neither. */
std::optional<Timestamp> stationTime(const std::string& text, Duration unit);
}  // namespace scanloom
