#include "diagnosis/internal/ClockKind.h"

#include <array>

namespace scanloom
{
namespace
{
constexpr Duration kTaiAheadOfUtc = 37s;
constexpr Duration kGpsAheadOfUtc = 18s;
constexpr Duration kGpsEpoch = 315964800s;  // 1980-01-06 in Unix time
constexpr Duration kTolerance = 5s;
constexpr Duration kTenYears = 10 * 31557600s;

struct Candidate
{
  Epoch epoch;
  Duration ahead;  // of UTC
};
constexpr std::array kCandidates{Candidate{Epoch::Utc, 0s}, Candidate{Epoch::Tai, kTaiAheadOfUtc},
                                 Candidate{Epoch::GpsAsUnix, kGpsAheadOfUtc},
                                 Candidate{Epoch::Gps, kGpsAheadOfUtc - kGpsEpoch}};
}  // namespace

std::string toString(Epoch epoch)
{
  switch (epoch)
  {
    case Epoch::Utc:
      return "UTC";
    case Epoch::Tai:
      return "TAI";
    case Epoch::GpsAsUnix:
      return "GPS seconds on the Unix epoch";
    case Epoch::Gps:
      return "GPS";
    case Epoch::SinceBoot:
      return "since boot";
    case Epoch::Other:
      return "unknown epoch";
  }
  return "";
}

Epoch epochOf(Timestamp stamp, Timestamp received)
{
  const Duration ahead = stamp - received;
  for (const Candidate& candidate : kCandidates)
    if (std::chrono::abs(ahead - candidate.ahead) < kTolerance) return candidate.epoch;
  return stamp.time_since_epoch() < kTenYears ? Epoch::SinceBoot : Epoch::Other;
}
}  // namespace scanloom
