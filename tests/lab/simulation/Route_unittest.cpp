#include "lab/simulation/internal/Route.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/messageOf.h"
#include "support/with.h"

namespace scanloom::route_unittest
{
namespace
{
DriveOptions hourOfWork()
{
  DriveOptions options;
  options.route = "work";
  options.duration = 3600;
  options.speed_up = 1;
  return options;
}

std::string problemOf(const DriveOptions& drive, const WorkCycleOptions& work)
{
  return messageOf<std::invalid_argument>([&] { Route(drive, work, 1); });
}

TEST(Route, repeatsStepsAndStopsWithinTheBoundsThatWereGiven)
{
  const Route route(hourOfWork(), with(&WorkCycleOptions::turn_after, 0), 3);

  double left = 0, last_end = 2.5;
  int stops = 0;
  for (std::uint64_t i = 0; const auto stop = route.workStop(i); ++i, ++stops)
  {
    const double arrived = route.progress(stop->begin).value;
    EXPECT_GE(arrived - left, 1.0);
    EXPECT_LE(arrived - left, 3.0);
    EXPECT_NEAR(route.progress(0.5 * (stop->begin + stop->end)).value, arrived, 1e-9) << "stands while it works";
    const double fastest = route.progress(0.5 * (last_end + stop->begin)).rate;
    EXPECT_GE(fastest, 0.3);
    EXPECT_LE(fastest, 0.8);
    if (stop->end < 3600)
    {
      EXPECT_GE(stop->end - stop->begin, 30);
      EXPECT_LE(stop->end - stop->begin, 120);
    }
    left = arrived;
    last_end = stop->end;
  }
  EXPECT_GT(stops, 30);
  EXPECT_LT(stops, 100);
}

TEST(Route, returnsToTheStartAtItsOwnSpeedAndBeginsAnew)
{
  WorkCycleOptions work;
  work.work_min = work.work_max = 5;
  work.turn_after = 10;
  const Route route(hourOfWork(), work, 1);

  EXPECT_GE(route.farthest(), 10);
  EXPECT_LT(route.farthest(), 13);
  int returns = 0;
  double slowest = 0;
  for (double t = 0.1; t < 3600; t += 0.1)
  {
    returns += route.progress(t - 0.1).value > 1e-3 && route.progress(t).value < 1e-3;
    slowest = std::min(slowest, route.progress(t).rate);
  }
  EXPECT_GT(returns, 20);
  EXPECT_NEAR(slowest, -1.0, 1e-12);
}

TEST(Route, isDrawnFromTheSeed)
{
  const Route a(hourOfWork(), {}, 1), same(hourOfWork(), {}, 1), other(hourOfWork(), {}, 2);

  EXPECT_EQ(a.progress(1000).value, same.progress(1000).value);
  EXPECT_NE(a.progress(1000).value, other.progress(1000).value);
}

TEST(Route, namesTheOptionsThatCannotBeTogether)
{
  DriveOptions drive;
  drive.duration = 5;
  EXPECT_NE(problemOf(drive, {}).find("duration = 5 s"), std::string::npos);
  drive = hourOfWork();
  drive.speed_up = 2;
  EXPECT_NE(problemOf(drive, {}).find("speed_up = 2 s"), std::string::npos);
  EXPECT_NE(problemOf(hourOfWork(), with(&WorkCycleOptions::work_min, 200)).find("work_min = 200"), std::string::npos);
  drive.route = "home";
  EXPECT_NE(problemOf(drive, {}).find("'home'"), std::string::npos);
}
}  // namespace
}  // namespace scanloom::route_unittest
