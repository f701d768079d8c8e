// The paper's section 1.1: what approach A costs, on simulated packets of two lidars and objects that move at 10 km/h.
// The whole table: scanloom_bench_whole_turns_approaches.
#include <gtest/gtest.h>

#include "support/MovingPanels.h"

namespace scanloom::approaches_unittest
{
using namespace scanloom::panels;

namespace
{
Figures byTime(const Mounting& mounting) { return figuresOf(scansByTime(mounting)); }

Figures byTurns(TurnGrouping grouping, const Mounting& mounting) { return figuresOf(scansOfTurns(grouping, mounting)); }

constexpr double kColumn = seconds(kTurn) / kColumns;
constexpr double kSmearOfATurn = kSpeed * 0.1;  // 0.278 m

// A beam sweeps a panel in 1.3 ms, and the lidars see it from places 1 m apart, up to 0.8 ms of the turn.
constexpr double kSmearOfASighting = kSpeed * 2.1e-3;
}  // namespace

TEST(Approaches, wholeTurnsShowHalfOfAllObjectsTwice28CentimetresApartInTheWorstPhase)
{
  const Figures figures = byTurns(TurnGrouping::Nearest, inStep(50ms));

  EXPECT_NEAR(figures.shareAbove(kDoubled), 0.5, 0.05);
  EXPECT_NEAR(figures.smear(0.6), kSmearOfATurn, kSmearOfASighting);
  EXPECT_NEAR(seconds(figures.longest_span), 0.15 - kColumn, 1e-8);
}

TEST(Approaches, byTimeTheSameObjectsAreSharpInAnyPhase)
{
  for (const Duration phase : {0ms, 20ms, 50ms, 90ms})
  {
    const Figures figures = byTime(inStep(phase));
    EXPECT_LT(figures.smear(0.95), kSmearOfASighting + 1e-3);  // ranges are in mm
    EXPECT_LE(figures.shareAbove(kDoubled), 1.01 / kPanels);   // the one over which both beams are when a scan ends
    EXPECT_LT(figures.smear(1), kSmearOfATurn + kSmearOfASighting);
    EXPECT_LT(figures.longest_span, 100ms);
  }
}

TEST(Approaches, turnedAlikeTheSecondBeamIsLateByThePhaseInEither)
{
  for (const Duration phase : {10ms, 40ms})
  {
    const double late = kSpeed * seconds(phase);
    EXPECT_NEAR(byTime(alike(phase)).smear(0.5), late, kSmearOfASighting);
    EXPECT_NEAR(byTurns(TurnGrouping::Nearest, alike(phase)).smear(0.5), late, kSmearOfASighting);
  }
}

TEST(Approaches, wholeTurnsWaitForEachOtherWhereBlocksDoNot)
{
  const Duration packet = kColumnsPerPacket * kTurn / kColumns;
  for (const Duration phase : {10ms, 40ms, 70ms})
  {
    const Figures time = byTime(alike(phase));
    EXPECT_LE(time.longest_held, packet);

    const Figures nearest = byTurns(TurnGrouping::Nearest, alike(phase));
    EXPECT_EQ(nearest.longest_held, std::min(phase, kTurn - phase));
    const Figures one_of_each = byTurns(TurnGrouping::OneOfEach, alike(phase));
    EXPECT_EQ(one_of_each.longest_held, phase);
    EXPECT_NEAR(seconds(one_of_each.longest_span), seconds(kTurn + phase) - kColumn, 1e-8);
  }
}
}  // namespace scanloom::approaches_unittest
