/** Extrinsics of lidars from one instant among stems, compared with the poses from which the clouds were made. */
#include "calibration/StaticExtrinsics.h"

#include "calibration/seenInWorld.h"

#include <gtest/gtest.h>

namespace scanloom::static_extrinsics_unittest
{
namespace
{
const Rigid kTop = at(0, 0, 3), kLeft = at(0, 0.6, 2.6, 90, 0, -40), kRight = at(0.1, -0.6, 2.6, -90, 0, -40);

/** What a lidar at `true_pose` sees, said to be at `given`. */
StaticLidar seenFrom(const Rigid& true_pose, const Rigid& given, std::uint64_t seed)
{
  constexpr int kStems = 200;
  return {scanFrom(forest(1, kStems), true_pose, seed, lidar()), given};
}

/** The points within a sector (deg) about the z axis of the world. */
StaticLidar onlySector(StaticLidar seen, const Rigid& pose, double from_deg, double to_deg)
{
  std::vector<Eigen::Vector3f> kept;
  for (const Eigen::Vector3f& p : seen.points)
  {
    const Eigen::Vector3d world = pose * p.cast<double>();
    const double bearing = std::atan2(world.y(), world.x()) / kDegree;
    if (bearing > from_deg && bearing < to_deg) kept.push_back(p);
  }
  seen.points = std::move(kept);
  return seen;
}

void expectPose(const ExtrinsicsEstimate& estimate, const Rigid& truth)
{
  ASSERT_EQ(estimate.outcome, ExtrinsicsOutcome::Estimated);
  EXPECT_LT((estimate.extrinsics.body_T_sensor.translation - truth.translation).norm(), 0.02);
  EXPECT_LT(estimate.extrinsics.body_T_sensor.rotation.angularDistance(truth.rotation) / kDegree, 0.15);
}
}  // namespace

TEST(StaticExtrinsics, ofThreeLidarsThatAreTenDegreesOffAreTheirPoses)
{
  const std::vector<ExtrinsicsEstimate> estimates =
      estimateStaticExtrinsics({seenFrom(kTop, kTop, 1), seenFrom(kLeft, at(0.1, 0.5, 2.8, 98, 5, -44), 2),
                                seenFrom(kRight, at(0, -0.8, 2.5, -81, -3, -42), 3)},
                               0, PoseGiven::Within20Degrees);
  expectPose(estimates[1], kLeft);
  expectPose(estimates[2], kRight);
  EXPECT_GT(estimates[1].shared_after, estimates[1].shared_before);
}

TEST(StaticExtrinsics, withoutAnyPoseInASquareRoomAreOpen)
{
  const RayWorld room{{{Eigen::Vector3d::UnitZ(), 0},
                       {Eigen::Vector3d::UnitX(), 10},
                       {-Eigen::Vector3d::UnitX(), 10},
                       {Eigen::Vector3d::UnitY(), 10},
                       {-Eigen::Vector3d::UnitY(), 10}},
                      {}};
  const auto seenAt = [&](const Rigid& pose, std::uint64_t seed) {
    return StaticLidar{scanFrom(room, pose, seed, lidar()), Rigid::identity()};
  };
  const std::vector<ExtrinsicsEstimate> estimates =
      estimateStaticExtrinsics({seenAt(at(0, 0, 3), 1), seenAt(at(0, 0.6, 2.6, 40), 2)}, 0, PoseGiven::No);
  EXPECT_EQ(estimates[1].outcome, ExtrinsicsOutcome::Open);
}

TEST(StaticExtrinsics, withoutAnyPoseAreFoundInTheFrameOfTheReference)
{
  const std::vector<ExtrinsicsEstimate> estimates = estimateStaticExtrinsics(
      {seenFrom(kTop, Rigid::identity(), 1), seenFrom(kLeft, Rigid::identity(), 2)}, 0, PoseGiven::No);
  expectPose(estimates[1], kTop.inverse() * kLeft);
}

TEST(StaticExtrinsics, ofALidarThatSharesNothingWithTheReferenceAreFoundByTheOneBetween)
{
  const Rigid between = at(0, 0.6, 2.6, 90, 0, -10);
  const std::vector<ExtrinsicsEstimate> estimates =
      estimateStaticExtrinsics({onlySector(seenFrom(kTop, kTop, 1), kTop, -100, 80),
                                onlySector(seenFrom(between, at(0.05, 0.6, 2.6, 90, 0, -10), 2), between, -90, 170),
                                onlySector(seenFrom(between, at(0, 0.65, 2.6, 90, 0, -10), 3), between, 85, 179)},
                               0, PoseGiven::Within20Degrees);
  expectPose(estimates[1], between);
  expectPose(estimates[2], between);
  EXPECT_GT(estimates[2].covariance(0, 0), estimates[1].covariance(0, 0));
}

TEST(StaticExtrinsics, ofACoveredLidarStayAsGiven)
{
  StaticLidar covered = seenFrom(kLeft, kLeft, 2);
  for (Eigen::Vector3f& p : covered.points) p = 0.8F * p.normalized();
  const std::vector<ExtrinsicsEstimate> estimates =
      estimateStaticExtrinsics({seenFrom(kTop, kTop, 1), covered}, 0, PoseGiven::Within20Degrees);
  EXPECT_NE(estimates[1].outcome, ExtrinsicsOutcome::Estimated);
  EXPECT_EQ(estimates[1].extrinsics.body_T_sensor.translation, kLeft.translation);
}
}  // namespace scanloom::static_extrinsics_unittest
