#include "input/packets/internal/SteadyStamps.h"

#include <gtest/gtest.h>

#include <time.h>

namespace scanloom::steady_stamps_unittest
{
namespace
{
/** The host's clocks `since_start` after a start at which they showed 1000 s and 50 s; the real one was set by `set`.
 */
HostClocks clocksAt(Duration since_start, Duration set = 0s)
{
  return {fromNanoseconds(0) + 1000s + since_start + set, 50s + since_start};
}

Timestamp steadyAt(Duration since_start) { return fromNanoseconds(0) + 1000s + since_start; }
}  // namespace

TEST(SteadyStamps, areTheKernelsOwnAsLongAsNobodySetsTheClock)
{
  SteadyStamps stamps(clocksAt(0s));
  stamps.observe(clocksAt(10s));

  EXPECT_EQ(stamps.steady(clocksAt(9s).realtime, {}, steadyAt(10s)), steadyAt(9s));
  EXPECT_EQ(stamps.steps(), 0u);
}

TEST(SteadyStamps, goOnAsBeforeWhenTheClockIsSet)
{
  for (const Duration step : {37s, -37s, 1s, -1s})
  {
    SteadyStamps stamps(clocksAt(0s));
    stamps.observe(clocksAt(10s, step));

    const Timestamp before = stamps.steady(clocksAt(9999ms).realtime, steadyAt(9998ms), steadyAt(10s));
    const Timestamp after = stamps.steady(clocksAt(10s, step).realtime, before, steadyAt(10s));

    EXPECT_EQ(before, steadyAt(9999ms)) << "stamped before the step, seen after it";
    EXPECT_EQ(after, steadyAt(10s));
    EXPECT_EQ(stamps.steps(), 1u);
  }
}

TEST(SteadyStamps, keepTheFirstClockOverManySteps)
{
  SteadyStamps stamps(clocksAt(0s));
  stamps.observe(clocksAt(1s, 5s));
  stamps.observe(clocksAt(2s, -5s));
  stamps.observe(clocksAt(3s, 100s));

  EXPECT_EQ(stamps.steady(clocksAt(3s, 100s).realtime, steadyAt(2s), steadyAt(3s)), steadyAt(3s));
  EXPECT_EQ(stamps.at(clocksAt(4s, 100s)), steadyAt(4s));
  EXPECT_EQ(stamps.steps(), 3u);
}

TEST(SteadyStamps, takeTheTimeOfReceptionForAStampThatNothingExplains)
{
  SteadyStamps stamps(clocksAt(0s));
  EXPECT_EQ(stamps.steady(clocksAt(0s, 1000s).realtime, steadyAt(0s), steadyAt(1s)), steadyAt(1s));
}

TEST(SteadyStamps, slewingIsNoStep)
{
  SteadyStamps stamps(clocksAt(0s));
  stamps.observe(clocksAt(10s, 100us));
  EXPECT_EQ(stamps.steps(), 0u);
}

TEST(HostClocks, areReadAtOneInstant)
{
  timespec before{}, after{};
  clock_gettime(CLOCK_MONOTONIC, &before);
  const HostClocks clocks = HostClocks::now();
  clock_gettime(CLOCK_MONOTONIC, &after);
  EXPECT_GE(clocks.monotonic, std::chrono::seconds(before.tv_sec) + Duration(before.tv_nsec));
  EXPECT_LE(clocks.monotonic, std::chrono::seconds(after.tv_sec) + Duration(after.tv_nsec));
}
}  // namespace scanloom::steady_stamps_unittest
