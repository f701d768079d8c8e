/** The epoch of a lidar's stamps, guessed by comparing them with the times of arrival. */
#pragma once
#include "base/core/Time.h"

#include <string>

namespace scanloom
{
enum class Epoch
{
  Utc,        // Unix time, as the computer's clock
  Tai,        // 37 s ahead of UTC: a PTP master distributes TAI, and the offset is not subtracted
  GpsAsUnix,  // 18 s ahead of UTC: GPS seconds counted from the Unix epoch
  Gps,        // seconds since 1980
  SinceBoot,  // less than ten years
  Other,
};

/** "UTC", "TAI", ... */
std::string toString(Epoch);

/** Leap seconds as of 2017, the latest one. The computer's clock may be wrong by up to 5 s. */
Epoch epochOf(Timestamp stamp, Timestamp received);
}  // namespace scanloom
