#include "input/rawlogs/Conversions.h"

#include <algorithm>
#include <limits>

namespace scanloom
{
namespace
{
// 1601-01-01 to 1970-01-01: 134774 days.
constexpr std::int64_t kTicksAtUnixEpoch = 134774LL * 86400 * 10'000'000;
constexpr std::int64_t kNanosecondsPerTick = 100;

constexpr std::int64_t floorDivide(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }
}  // namespace

mrpt::Clock::time_point toMrpt(Timestamp stamp)
{
  const auto ticks = floorDivide(nanoseconds(stamp), kNanosecondsPerTick);
  return mrpt::Clock::time_point(mrpt::Clock::duration(kTicksAtUnixEpoch + ticks));
}

Timestamp fromMrpt(mrpt::Clock::time_point time)
{
  // Half of what fits: then no difference of two stamps overflows.
  constexpr std::int64_t kMostTicks = std::numeric_limits<std::int64_t>::max() / kNanosecondsPerTick / 2;
  const auto ticks = std::clamp<std::int64_t>(time.time_since_epoch().count(), kTicksAtUnixEpoch - kMostTicks,
                                              kTicksAtUnixEpoch + kMostTicks);
  return fromNanoseconds((ticks - kTicksAtUnixEpoch) * kNanosecondsPerTick);
}

mrpt::poses::CPose3D toMrpt(const Rigid& pose)
{
  return mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(pose.matrix()));
}

Rigid fromMrpt(const mrpt::poses::CPose3D& pose)
{
  return Rigid::fromMatrix(pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen());
}
}  // namespace scanloom
