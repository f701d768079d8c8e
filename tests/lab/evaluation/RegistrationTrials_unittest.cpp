#include "lab/evaluation/internal/RegistrationTrials.h"

#include <gtest/gtest.h>

namespace scanloom::registration_trials_unittest
{
namespace
{
const Rigid kTruth = Rigid::fromXyzYawPitchRoll(3, -2, 1, 0.7, 0.2, -0.4);

TrialOptions spread(double metres, double degrees, SpreadAxis axis = SpreadAxis::Any)
{
  TrialOptions options;
  options.trials = 40;
  options.spread = metres;
  options.spread_deg = degrees;
  options.axis = axis;
  return options;
}

TimedRegistration ended(const Rigid& pose, Outcome outcome = Outcome::Converged)
{
  RegistrationResult result;
  result.target_T_source = pose;
  result.outcome = outcome;
  result.information = Matrix6d::Identity();
  return {result, 2};
}

TEST(RegistrationTrials, beginExactlySoFarOff)
{
  for (const Rigid& guess : guessesAround(kTruth, spread(2, 20)))
  {
    const Rigid offset = kTruth.inverse() * guess;
    EXPECT_NEAR(offset.translation.norm(), 2, 1e-12);
    EXPECT_NEAR(Eigen::AngleAxisd(offset.rotation).angle() * 180 / M_PI, 20, 1e-9);
  }
}

TEST(RegistrationTrials, coverAllDirections)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();
  TrialOptions options = spread(1, 0);
  options.trials = 3000;
  for (const Rigid& guess : guessesAround(Rigid::identity(), options))
  {
    sum += guess.translation;
    squares += guess.translation.cwiseAbs2();
  }
  EXPECT_LT((sum / 3000).norm(), 0.05);
  EXPECT_LT((squares / 3000 - Eigen::Vector3d::Constant(1.0 / 3)).norm(), 0.03);
}

TEST(RegistrationTrials, mayTurnAboutTheVerticalOnlyAndThenEitherWay)
{
  int left = 0;
  for (const Rigid& guess : guessesAround(kTruth, spread(0, 20, SpreadAxis::Vertical)))
  {
    const Eigen::Vector3d angles = (kTruth.inverse() * guess).yawPitchRoll() * 180 / M_PI;
    EXPECT_NEAR(std::abs(angles[0]), 20, 1e-9);
    EXPECT_NEAR(angles.tail<2>().norm(), 0, 1e-9);
    left += angles[0] > 0;
  }
  EXPECT_GT(left, 5);
  EXPECT_LT(left, 35);
}

TEST(RegistrationTrials, areTheSameForASeedAndOthersForAnother)
{
  TrialOptions options = spread(1, 10);
  const auto first = guessesAround(kTruth, options), again = guessesAround(kTruth, options);
  options.seed = 2;
  const auto others = guessesAround(kTruth, options);

  for (std::size_t i = 0; i < first.size(); ++i)
  {
    EXPECT_EQ(first[i].matrix(), again[i].matrix());
    EXPECT_NE(first[i].matrix(), others[i].matrix());
  }
}

TEST(RegistrationTrials, ofARegistrationThatAlwaysErrsAlikeSayHowMuch)
{
  Vector6d error;
  error << 0.03, 0, 0.04, 0, 0.01, 0;
  const TrialsReport report =
      tryRegistration(kTruth, spread(1, 10), [&](const Rigid&) { return ended(boxPlus(kTruth, error)); });

  EXPECT_EQ(report.success_rate, 1);
  EXPECT_NEAR(report.metres.median, 0.05, 1e-12);
  EXPECT_NEAR(report.degrees.largest, 0.01 * 180 / M_PI, 1e-9);
  EXPECT_EQ(report.milliseconds.mean, 2);
  EXPECT_NEAR(report.mean_nees.value(), 0.05 * 0.05 + 0.01 * 0.01, 1e-6);
}

TEST(RegistrationTrials, countFailuresAndOutcomesApart)
{
  int trial = 0;
  const TrialsReport report = tryRegistration(
      kTruth, spread(1, 10),
      [&](const Rigid& guess) { return ++trial % 4 == 0 ? ended(guess, Outcome::LowOverlap) : ended(kTruth); });

  EXPECT_EQ(report.success_rate, 0.75);
  EXPECT_EQ(report.outcomes.at(Outcome::LowOverlap), 10U);
  EXPECT_EQ(report.metres.median, 0);
  EXPECT_NEAR(report.metres.percentile_95, 1, 1e-12);
}

TEST(RegistrationTrials, withoutSuccessHaveNoConsistency)
{
  const auto unmoved = [](const Rigid& guess) { return ended(guess); };
  EXPECT_FALSE(tryRegistration(kTruth, spread(1, 10), unmoved).mean_nees);
  EXPECT_THROW(tryRegistration(kTruth, TrialOptions{0}, unmoved), std::invalid_argument);
}
}  // namespace
}  // namespace scanloom::registration_trials_unittest
