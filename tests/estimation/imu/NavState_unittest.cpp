#include "estimation/imu/NavState.h"

#include "estimation/imu/AnalyticDrive.h"

#include <gtest/gtest.h>

namespace scanloom::nav_state_unittest
{
TEST(NavState, boxMinusUndoesBoxPlus)
{
  const NavState state = AnalyticDrive{}.stateAt(Timestamp{3s}, {{0.01, 0.02, 0.03}, {0.1, 0.2, 0.3}});
  const Vector15d step = Noise(1).normal<15>(0.4);
  EXPECT_LT((boxMinus(boxPlus(state, step), state) - step).norm(), 1e-14);
}

TEST(NavState, knowsWhenAValueIsNotFinite)
{
  NavState state;
  EXPECT_TRUE(state.allFinite());
  state.bias.accel.z() = NAN;
  EXPECT_FALSE(state.allFinite());
}
}  // namespace scanloom::nav_state_unittest
