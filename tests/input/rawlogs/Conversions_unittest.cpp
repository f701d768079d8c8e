#include "input/rawlogs/Conversions.h"

#include <gtest/gtest.h>

#include <limits>

namespace scanloom::conversions_unittest
{
namespace
{
TEST(Conversions, takeTheNearestInstantWhereDifferencesEnd)
{
  const auto of = [](std::int64_t ticks) { return fromMrpt(mrpt::Clock::time_point(mrpt::Clock::duration(ticks))); };
  using Limits = std::numeric_limits<std::int64_t>;
  EXPECT_LT(of(0), fromNanoseconds(-4'600'000'000'000'000'000)) << "MRPT's invalid stamp: 1601";
  EXPECT_LT(of(Limits::min()), fromNanoseconds(-4'600'000'000'000'000'000));
  EXPECT_GT(of(Limits::max()), fromNanoseconds(4'600'000'000'000'000'000));
  EXPECT_GT(of(Limits::max()) - of(Limits::min()), Duration{0}) << "a difference of stamps does not overflow";
}
}  // namespace
}  // namespace scanloom::conversions_unittest
