#include "estimation/slam/internal/MapDriftModel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "estimation/graph/PosePriorFactor.h"

namespace scanloom::map_drift_model_unittest
{
namespace
{
Matrix6d deviations(double position, double heading)
{
  Vector6d d;
  d << position, position, position, 0, 0, heading;
  return d.cwiseAbs2().asDiagonal();
}

/** Variance of x of each of `n` keyframes after the first, of which each is aligned to the `lags` before it. */
std::vector<double> variancesOfChain(std::size_t n, std::size_t lags, double deviation)
{
  MapDriftModel errors;
  std::vector<ErrorShares> keyframes(1);
  std::vector<double> variances{0};
  for (std::size_t i = 1; i <= n; ++i)
  {
    std::vector<WeightedError> before;
    for (std::size_t lag = 1; lag <= std::min(lags, i); ++lag) before.push_back({3.0, keyframes[i - lag]});
    keyframes.push_back(errors.add(meanOf(before), {}, deviations(deviation, 0)));
    variances.push_back(errors.covariance(keyframes.back())(0, 0));
  }
  return variances;
}
}  // namespace

TEST(MapDriftModel, growAsARandomWalkWhereEachKeyframeIsAlignedToTheOneBefore)
{
  EXPECT_NEAR(variancesOfChain(20, 1, 0.1)[20], 20 * 0.01, 1e-12);
}

// Renewal theory: the share of one alignment's error in all later keyframes tends to 1 / (mean lag).
TEST(MapDriftModel, growSlowerByTheSquareOfTheMeanLagWhereEachIsAlignedToSeveral)
{
  for (const std::size_t lags : {2u, 3u, 12u})
  {
    const std::vector<double> variances = variancesOfChain(400, lags, 0.1);
    const double mean_lag = (1 + static_cast<double>(lags)) / 2;
    EXPECT_NEAR((variances[400] - variances[300]) / 100, 0.01 / (mean_lag * mean_lag), 1e-6) << lags;
  }
}

TEST(MapDriftModel, aHeadingSwingsWhatLiesAhead)
{
  MapDriftModel errors;
  const ErrorShares error = errors.add({}, Rigid::fromXyzYawPitchRoll(10, 0, 0, M_PI / 2, 0, 0), deviations(0, 0.01));
  const Matrix6d covariance = movedTo(Rigid::fromXyzYawPitchRoll(10, 3, 0, 0, 0, 0), errors.covariance(error));
  EXPECT_NEAR(covariance(0, 0), std::pow(3 * 0.01, 2), 1e-12);
  EXPECT_NEAR(covariance(1, 1), 0, 1e-12);
  EXPECT_NEAR(covariance(5, 5), 0.01 * 0.01, 1e-12);
}

TEST(MapDriftModel, theMeanOfTwoAlignmentsHasHalfTheVarianceAndOfOneWithItselfAll)
{
  MapDriftModel errors;
  const ErrorShares first = errors.add({}, {}, deviations(0.1, 0)), second = errors.add({}, {}, deviations(0.1, 0));
  EXPECT_NEAR(errors.covariance(meanOf({{5, first}, {5, second}}))(0, 0), 0.005, 1e-12);
  EXPECT_NEAR(errors.covariance(meanOf({{5, second}, {5, second}}))(0, 0), 0.01, 1e-12);
}
}  // namespace scanloom::map_drift_model_unittest
