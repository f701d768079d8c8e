#include "slam/ScanRegistration.h"

#include <gtest/gtest.h>

#include "StandOfStems.h"

using namespace scanloom;

namespace
{
const Rigid kMapPose = Rigid::fromXyzYawPitchRoll(0, 0, 1.5, 0.2, 0, 0);

std::vector<View> viewsAt(const Rigid& map_T_body, unsigned stand = 1)
{
  return viewsOf(StandOfStems(stand).scanAt(Timestamp{0s}, [&](Timestamp) { return map_T_body; }).points, {});
}

/** Of a scan taken at kMapPose, in its frame. */
NdtMap mapOfOneScan(const SlamSettings& settings) { return NdtMap(viewsAt(kMapPose), settings.map_cells); }

PoseGuess guessWith(const Rigid& pose, double metres, double radians)
{
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(metres), Eigen::Vector3d::Constant(radians);
  return {pose, Matrix6d(sigma.cwiseAbs2().asDiagonal())};
}

double distance(const Rigid& a, const Rigid& b) { return boxMinus(a, b).norm(); }
}  // namespace

TEST(ScanRegistration, findsAPoseFromWithinTheReachOfTheRoughCells)
{
  const SlamSettings settings;
  StageTimes times;
  const Rigid truth = Rigid::fromXyzYawPitchRoll(1, -0.5, 0.1, 0.1, 0, 0.02);
  const Rigid off = truth * Rigid::fromXyzYawPitchRoll(0.3, -0.2, 0.1, 0.03, 0, 0);
  const auto result =
      registerScan(mapOfOneScan(settings), viewsAt(kMapPose * truth), guessWith(off, 0.2, 0.02), settings, times);
  EXPECT_LT(distance(result.target_T_source, truth), 0.02);
}

TEST(ScanRegistration, goesThroughCoarserCellsWhenTheGuessIsUnsure)
{
  const SlamSettings settings;
  StageTimes times;
  const Rigid truth = Rigid::fromXyzYawPitchRoll(1, -0.5, 0.1, 0.1, 0, 0.02);
  const Rigid off = truth * Rigid::fromXyzYawPitchRoll(1.5, -1.5, 0, 0.25, 0, 0);
  const NdtMap map = mapOfOneScan(settings);
  const std::vector<View> cloud = viewsAt(kMapPose * truth);
  EXPECT_LT(distance(registerScan(map, cloud, guessWith(off, 1.2, 0.15), settings, times).target_T_source, truth),
            0.02);
}

TEST(ScanRegistration, relocalisesFromAnywhereNearby)
{
  const SlamSettings settings;
  const Rigid truth = Rigid::fromXyzYawPitchRoll(2, 1, 0, 0.3, 0, 0);
  const auto found = relocalise(mapOfOneScan(settings), viewsAt(kMapPose * truth),
                                SearchArea{Rigid::fromXyzYawPitchRoll(-2, 4, 0, 2.5, 0, 0), 5}, settings);
  ASSERT_TRUE(found);
  EXPECT_LT(distance(found->target_T_source, truth), 0.05);
}

TEST(ScanRegistration, doesNotRelocaliseInAnotherStand)
{
  const SlamSettings settings;
  EXPECT_FALSE(relocalise(mapOfOneScan(settings), viewsAt(kMapPose, 7), SearchArea{}, settings));
}
