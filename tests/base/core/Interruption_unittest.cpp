#include "base/core/Interruption.h"

#include <gtest/gtest.h>

#include <csignal>

namespace scanloom::interruption_unittest
{
TEST(Interruption, isSeenAndDoesNotEndTheProgramTheFirstTime)
{
  catchInterruption();
  EXPECT_FALSE(interrupted());
  std::raise(SIGINT);
  EXPECT_TRUE(interrupted());
  EXPECT_EXIT(std::raise(SIGINT), testing::KilledBySignal(SIGINT), "");
}

TEST(Interruption, leavesSignalsThatAreHandledToTheirHandlers)
{
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_DFL);
  catchUnhandledInterruption();

  std::raise(SIGINT);
  EXPECT_FALSE(interrupted());
  std::raise(SIGTERM);
  EXPECT_TRUE(interrupted());

  std::signal(SIGINT, SIG_DFL);
}

TEST(Interruption, endsWorkThatAsksForIt)
{
  std::signal(SIGTERM, SIG_DFL);
  catchUnhandledInterruption();
  EXPECT_NO_THROW(throwIfInterrupted());
  std::raise(SIGTERM);
  EXPECT_THROW(throwIfInterrupted(), Interrupted);

  catchUnhandledInterruption();  // clears it
  std::signal(SIGTERM, SIG_DFL);
}
}  // namespace scanloom::interruption_unittest
