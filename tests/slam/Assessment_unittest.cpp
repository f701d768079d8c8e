#include "slam/Assessment.h"

#include <gtest/gtest.h>

namespace scanloom
{
namespace
{
StateEstimate estimateAt(Duration stamp, bool trusted)
{
  StateEstimate estimate;
  estimate.stamp = Timestamp{stamp};
  estimate.trusted = trusted;
  return estimate;
}
}  // namespace

TEST(Assessment, isLostOnlyAfterTwoSecondsWithoutATrustedScan)
{
  const TrustHistory history{Timestamp{10s}, {}, {}};
  EXPECT_EQ(assess(estimateAt(11s, true), false, history, {}).health, Health::Ok);
  EXPECT_EQ(assess(estimateAt(11s, true), false, history, {}).last_trusted, Timestamp{11s});
  EXPECT_EQ(assess(estimateAt(12s, false), false, history, {}).health, Health::Degenerate);
  EXPECT_EQ(assess(estimateAt(13s, false), false, history, {}).health, Health::Lost);
  EXPECT_EQ(assess(estimateAt(13s, false), true, history, {}).health, Health::Ok) << "it opens the map";
}

TEST(Assessment, isLostWhereRegistrationsContradictTheImuForTenSeconds)
{
  TrustHistory history{Timestamp{10s}, {}, {}};
  for (int i = 0; i <= 100; ++i) history.contradiction.add(Timestamp{i * 100ms}, 20);
  const Assessment assessed = assess(estimateAt(10s, true), false, history, {});
  EXPECT_TRUE(assessed.contradicted);
  EXPECT_EQ(assessed.health, Health::Lost);
}
}  // namespace scanloom
