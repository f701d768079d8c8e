#include "estimation/slam/internal/ScanRegistration.h"

#include <gtest/gtest.h>

#include "StandOfStems.h"
#include "estimation/slam/internal/SlamSettings.h"

#include <limits>

namespace scanloom::scan_registration_unittest
{
namespace
{
const Rigid kMapPose = Rigid::fromXyzYawPitchRoll(0, 0, 1.5, 0.2, 0, 0);

PointCloud cloudAt(const Rigid& map_T_body, unsigned stand)
{
  return StandOfStems(stand).scanAt(Timestamp{0s}, [&](Timestamp) { return map_T_body; }).points;
}

std::vector<View> viewsAt(const Rigid& map_T_body, unsigned stand = 1)
{
  return viewsOf(cloudAt(map_T_body, stand), {});
}

/** Of what is nearer than `range` (m). */
std::vector<View> viewsInFogAt(const Rigid& map_T_body, unsigned stand, float range)
{
  PointCloud cloud = cloudAt(map_T_body, stand);
  std::vector<std::uint8_t> is_near;
  for (std::size_t i = 0; i < cloud.size(); ++i) is_near.push_back(std::hypot(cloud.x[i], cloud.y[i]) < range);
  cloud.keep(is_near);
  return viewsOf(cloud, {});
}

/** Of a scan taken at kMapPose, in its frame. */
NdtMap mapOfOneScan() { return NdtMap(viewsAt(kMapPose), SlamSettings().map_cells); }

PoseGuess guessWith(const Rigid& pose, double metres, double radians)
{
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(metres), Eigen::Vector3d::Constant(radians);
  return {pose, Matrix6d(sigma.cwiseAbs2().asDiagonal())};
}

RegistrationResult registerScan(const NdtMap& map, const std::vector<View>& views, const PoseGuess& guess,
                                const ScanRegistrationOptions& options)
{
  const Rigid rough = registerRoughly(map, views, guess, options).value.target_T_source;
  return registerFinely(map, views, rough, options).value;
}

std::optional<RegistrationResult> relocalise(const NdtMap& map, const std::vector<View>& views, const SearchArea& area)
{
  const ScanRegistrationOptions options = SlamSettings().registration;
  return scanloom::relocalise(
      map, views, startsWithin(area), [](const Rigid&) { return true; }, options.fine_cells, options.fine);
}

double distance(const Rigid& a, const Rigid& b) { return boxMinus(a, b).norm(); }
}  // namespace

TEST(ScanRegistration, findsAPoseFromWithinTheReachOfTheRoughCells)
{
  const Rigid truth = Rigid::fromXyzYawPitchRoll(1, -0.5, 0.1, 0.1, 0, 0.02);
  const Rigid off = truth * Rigid::fromXyzYawPitchRoll(0.3, -0.2, 0.1, 0.03, 0, 0);
  const auto result =
      registerScan(mapOfOneScan(), viewsAt(kMapPose * truth), guessWith(off, 0.2, 0.02), SlamSettings().registration);
  EXPECT_LT(distance(result.target_T_source, truth), 0.02);
}

TEST(ScanRegistration, goesThroughCoarserCellsWhenTheGuessIsUnsure)
{
  const Rigid truth = Rigid::fromXyzYawPitchRoll(1, -0.5, 0.1, 0.1, 0, 0.02);
  const Rigid off = truth * Rigid::fromXyzYawPitchRoll(1.5, -1.5, 0, 0.25, 0, 0);
  const NdtMap map = mapOfOneScan();
  const std::vector<View> cloud = viewsAt(kMapPose * truth);
  EXPECT_LT(
      distance(registerScan(map, cloud, guessWith(off, 1.2, 0.15), SlamSettings().registration).target_T_source, truth),
      0.02);
}

TEST(ScanRegistration, largeCellsThatConfuseStemsDoNotOverruleThePrediction)
{
  constexpr unsigned kStand = 7;
  const NdtMap map(viewsInFogAt(kMapPose, kStand, 5), SlamSettings().map_cells);
  const Rigid truth = Rigid::fromXyzYawPitchRoll(1, -0.5, 0, 0.1, 0, 0);
  const std::vector<View> views = viewsInFogAt(kMapPose * truth, kStand, 5);
  const PoseGuess guess = guessWith(truth * Rigid::fromXyzYawPitchRoll(-0.2, 0.2, 0, 0, 0, 0), 0.25, 0.01);
  const ScanRegistrationOptions options = SlamSettings().registration;
  ASSERT_GT(distance(registerRoughly(map, views, guess, options).value.target_T_source, truth), 1);
  EXPECT_LT(distance(registerTwice(map, views, guess, std::nullopt, options).value.target_T_source, truth), 0.05);
}

TEST(ScanRegistration, aPredictionThatFitsWorseThanWhatLargeCellsFindIsOverruled)
{
  const NdtMap map = mapOfOneScan();
  const Rigid truth = Rigid::fromXyzYawPitchRoll(1, -0.5, 0.1, 0.1, 0, 0.02);
  const PoseGuess guess = guessWith(truth * Rigid::fromXyzYawPitchRoll(0.9, -0.6, 0, 0, 0, 0), 0.05, 0.01);
  const RegistrationResult found =
      registerTwice(map, viewsAt(kMapPose * truth), guess, std::nullopt, SlamSettings().registration).value;
  EXPECT_GT(mahalanobisOf(found, guess), 5);
  EXPECT_LT(distance(found.target_T_source, truth), 0.02);
}

TEST(ScanRegistration, aCovarianceSpoiltByRoundingMakesTheSurpriseInfiniteAndThrowsNothing)
{
  RegistrationResult found;
  found.covariance(0, 0) = -1;
  EXPECT_EQ(mahalanobisOf(found, guessWith(Rigid::identity(), 0.1, 0.01)), std::numeric_limits<double>::infinity());
}

TEST(ScanRegistration, relocalisesFromAnywhereNearby)
{
  const Rigid truth = Rigid::fromXyzYawPitchRoll(2, 1, 0, 0.3, 0, 0);
  const auto found = relocalise(mapOfOneScan(), viewsAt(kMapPose * truth),
                                SearchArea{Rigid::fromXyzYawPitchRoll(-2, 4, 0, 2.5, 0, 0), 5});
  ASSERT_TRUE(found);
  EXPECT_LT(distance(found->target_T_source, truth), 0.05);
}

TEST(ScanRegistration, relocalisesFromTiltsThatAreFarOff)
{
  const NdtMap map = mapOfOneScan();
  const Rigid truth = Rigid::fromXyzYawPitchRoll(2, 1, 0, 0.3, 0, 0);
  const std::vector<View> cloud = viewsAt(kMapPose * truth);
  for (const double degrees : {7.0, 15.0})
    for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1, 0.3, 0), Eigen::Vector3d(-0.3, 1, 0)})
    {
      Rigid start = truth * Rigid::fromXyzYawPitchRoll(-2, 1.2, 0, 0.05, 0, 0);
      start.rotation = Eigen::AngleAxisd(degrees * M_PI / 180, axis.normalized()) * start.rotation;
      const auto found = relocalise(map, cloud, SearchArea{start, 3, 1});
      ASSERT_TRUE(found) << degrees;
      EXPECT_LT(distance(found->target_T_source, truth), 0.05) << degrees;
    }
}

TEST(ScanRegistration, whatTheLidarLeavesOpenIsKnownAsWellAsTheSearchKnewIt)
{
  RegistrationResult sharp, open;
  sharp.covariance = 1e-4 * Matrix6d::Identity();
  sharp.information = sharp.covariance.inverse();
  open.covariance = sharp.covariance;
  open.covariance(0, 0) = open.covariance(3, 3) = 1e6;
  open.information = open.covariance.inverse();
  const SearchArea area{{}, 5, 8};

  EXPECT_LT((covarianceWithin(area, sharp) - sharp.covariance).norm(), 0.01 * sharp.covariance.norm());
  const Matrix6d bounded = covarianceWithin(area, open);
  EXPECT_NEAR(std::sqrt(bounded(0, 0)), 8, 0.1);                 // m: how far the search reaches
  EXPECT_NEAR(std::sqrt(bounded(3, 3)), 15 * M_PI / 180, 1e-3);  // the tilt that it mends
  EXPECT_NEAR(bounded(1, 1), sharp.covariance(1, 1), 1e-6);
  EXPECT_EQ(bounded.llt().info(), Eigen::Success);
  EXPECT_LT(covarianceWithin(area, RegistrationResult{}).norm(), 8 * 8 * 2);  // no information at all
}

TEST(ScanRegistration, doesNotRelocaliseInAnotherStand)
{
  EXPECT_FALSE(relocalise(mapOfOneScan(), viewsAt(kMapPose, 7), SearchArea{}));
}
}  // namespace scanloom::scan_registration_unittest
