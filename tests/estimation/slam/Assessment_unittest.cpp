#include "estimation/slam/internal/Assessment.h"

#include <gtest/gtest.h>

namespace scanloom::assessment_unittest
{
TEST(Assessment, isLostOnlyAfterTwoSecondsWithoutATrustedScan)
{
  const TrustHistory history{Timestamp{10s}, {}, {}};
  EXPECT_EQ(assess(Timestamp{11s}, true, history, {}).health, Health::Ok);
  EXPECT_EQ(assess(Timestamp{11s}, true, history, {}).last_trusted, Timestamp{11s});
  EXPECT_EQ(assess(Timestamp{12s}, false, history, {}).health, Health::Degenerate);
  EXPECT_EQ(assess(Timestamp{13s}, false, history, {}).health, Health::Lost);
}

TEST(Assessment, isLostWhereRegistrationsContradictTheImuForTenSeconds)
{
  TrustHistory history{Timestamp{10s}, {}, {}};
  for (int i = 0; i <= 100; ++i) history.contradiction.add(Timestamp{i * 100ms}, 20);
  const Assessment assessed = assess(Timestamp{10s}, true, history, {});
  EXPECT_TRUE(assessed.contradicted);
  EXPECT_EQ(assessed.health, Health::Lost);
}

TEST(Assessment, isNotOkWhileTheImuIsSilent)
{
  TrustHistory history{Timestamp{10s}, {}, {}};
  history.imu_silent = true;
  EXPECT_EQ(assess(Timestamp{11s}, true, history, {}).health, Health::Degenerate);
}

TEST(Assessment, isNotOkWhereTheEstimateIsFarFromItsOwnRegistration)
{
  const Matrix6d covariance = 1e-4 * Matrix6d::Identity();  // 1 cm, 0.6 deg
  const auto healthAfter = [&](int registrations, double metres)
  {
    TrustHistory history{Timestamp{10s}, {}, {}};
    for (int i = 0; i < registrations; ++i) history.divergence.add(metres * Vector6d::Unit(1), covariance);
    return assess(Timestamp{11s}, true, history, {}).health;
  };
  EXPECT_EQ(healthAfter(100, 0.07), Health::Ok);
  EXPECT_EQ(healthAfter(3, 0.12), Health::Ok) << "a registration may be wrong";
  EXPECT_EQ(healthAfter(4, 0.12), Health::Degenerate);
  EXPECT_EQ(healthAfter(1, 0.2), Health::Degenerate);
}

TEST(DivergenceDetector, makesTheLidarBelievedAfterThreeThatAreFarOffInARow)
{
  const Matrix6d covariance = 1e-4 * Matrix6d::Identity();
  DivergenceDetector divergence;
  for (int i = 0; i < 2; ++i) divergence.add(0.2 * Vector6d::Unit(1), covariance);
  EXPECT_FALSE(divergence.level() == Divergence::Persistent)
      << "registrations may be wrong: of a lidar with 16 beams that begins to drive";
  divergence.add(0.2 * Vector6d::Unit(1), covariance);
  EXPECT_TRUE(divergence.level() == Divergence::Persistent);
  divergence.add(Vector6d::Zero(), covariance);
  EXPECT_FALSE(divergence.level() >= Divergence::Suspected);
}
}  // namespace scanloom::assessment_unittest
