/** Which time a lidar's stamps tell, guessed from what they read when the packets arrived. */
#pragma once
#include "core/Time.h"

#include <string>

namespace scanloom
{
enum class Epoch
{
  Utc,        // Unix time, as the computer's
  Tai,        // 37 s ahead of it: a PTP master that distributes TAI, and nobody subtracts the offset
  GpsAsUnix,  // 18 s ahead: GPS seconds on the Unix epoch
  Gps,        // seconds since 1980
  SinceBoot,  // less than ten years
  Other,
};

/** "UTC", "TAI", ... as people call it. */
std::string toString(Epoch);

/** Leap seconds as of 2017, the last one so far. A host may be off by up to 5 s and is still recognised. */
Epoch epochOf(Timestamp stamp, Timestamp received);
}  // namespace scanloom
