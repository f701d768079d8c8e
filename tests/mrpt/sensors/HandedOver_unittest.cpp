#include "mrpt/sensors/internal/HandedOver.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>

#include <vector>

namespace scanloom::handed_over_unittest
{
using namespace std::chrono_literals;
using mrpt::obs::CObservationComment;

TEST(HandedOver, countsWhatTheApplicationStillHolds)
{
  const HandedOver::Time now{};
  HandedOver given(1s);
  std::vector<CObservationComment::Ptr> application = {CObservationComment::Create(), CObservationComment::Create()};
  for (const auto& observation : application) given.add(observation, now);

  EXPECT_EQ(given.held(now), 2u);
  application.pop_back();
  EXPECT_EQ(given.held(now), 1u);
  application.pop_back();
  EXPECT_FALSE(given.isWorthWaitingFor(now));
}

TEST(HandedOver, losesPatienceWithAnApplicationThatKeepsEverything)
{
  const HandedOver::Time start{};
  HandedOver given(1s);
  const auto kept = CObservationComment::Create();
  given.add(kept, start);

  EXPECT_TRUE(given.isWorthWaitingFor(start + 999ms));
  EXPECT_FALSE(given.isWorthWaitingFor(start + 1s));
}

TEST(HandedOver, isPatientAgainWheneverSomethingIsFreed)
{
  const HandedOver::Time start{};
  HandedOver given(1s);
  auto first = CObservationComment::Create();
  const auto second = CObservationComment::Create();
  given.add(first, start);
  given.add(second, start);

  first.reset();
  EXPECT_EQ(given.held(start + 900ms), 1u);
  EXPECT_TRUE(given.isWorthWaitingFor(start + 1800ms));
}
}  // namespace scanloom::handed_over_unittest
