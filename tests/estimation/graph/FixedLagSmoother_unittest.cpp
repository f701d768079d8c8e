#include "estimation/graph/FixedLagSmoother.h"

#include "base/core/Decompositions.h"
#include "estimation/graph/PosePriorFactor.h"
#include "estimation/graph/SimulatedDrive.h"
#include "support/with.h"

#include <gtest/gtest.h>

namespace scanloom::fixed_lag_smoother_unittest
{
namespace
{
const AnalyticDrive kDrive;

SmootherOptions withoutHuber(int window, int iterations = 6) { return {window, iterations, 0}; }

/** A machine that only shifts: its attitude never changes, so that the problem is linear but for attitude errors. */
AnalyticDrive straightDrive()
{
  AnalyticDrive drive;
  drive.yaw = drive.pitch = drive.roll = Sine{};
  return drive;
}

FixedLagSmoother run(const SimulatedDrive& drive, const DriveNoise& noise, const SmootherOptions& options)
{
  FixedLagSmoother smoother = smootherFor(drive, noise, options);
  for (std::size_t k = 1; k < drive.truth.size(); ++k)
  {
    feed(smoother, drive, k);
    smoother.optimise();
  }
  return smoother;
}

/** All states at once, nothing forgotten. */
NavState batch(const SimulatedDrive& drive, const DriveNoise& noise, int iterations = 30)
{
  FixedLagSmoother smoother = smootherFor(drive, noise, withoutHuber(static_cast<int>(drive.truth.size()), iterations));
  for (std::size_t k = 1; k < drive.truth.size(); ++k) feed(smoother, drive, k);
  return smoother.optimise();
}

bool isFiniteAndSymmetric(const Matrix15d& c)
{
  return c.allFinite() && (c - c.transpose()).norm() <= 1e-12 * c.norm();
}
}  // namespace

TEST(FixedLagSmoother, equalsTheBatchWhereTheProblemIsLinear)
{
  // Errors a millionth of their usual size: what is not linear is below 1e-12 of the states.
  DriveNoise noise;
  noise.share = 1e-6;
  const SimulatedDrive drive = simulate(straightDrive(), 20, 200ms, noise, 1);
  const FixedLagSmoother smoother = run(drive, noise, withoutHuber(4));
  const Vector15d difference = boxMinus(smoother.newest(), batch(drive, noise));
  EXPECT_LT(difference.norm(), 1e-9);

  // And not because nothing happens: relative to the errors at play, too.
  const Matrix15d covariance = smoother.newestCovariance();
  EXPECT_LT(std::sqrt(difference.dot(solveSymmetric(covariance, difference))) / noise.share, 1e-3);
}

TEST(FixedLagSmoother, staysWithinACentimetreOfTheBatchOnADrive)
{
  const DriveNoise noise;
  const SimulatedDrive drive = simulate(kDrive, 40, 200ms, noise, 2);
  const NavState windowed = run(drive, noise, withoutHuber(5)).newest();
  const NavState all = batch(drive, noise);
  EXPECT_LT((windowed.map_T_imu.translation - all.map_T_imu.translation).norm(), 0.01);
  EXPECT_LT(boxMinus(windowed, all).norm(), 0.01);
  EXPECT_LT(boxMinus(windowed, drive.truth.back()).head<3>().norm(), 0.05);
}

/** Ceres 2.2 rounds otherwise than Ceres 2.1 (Debian 12), whose result this is. */
TEST(FixedLagSmoother, givesTheSamePlaceUnderEveryCeres)
{
  const DriveNoise noise;
  const NavState newest = run(simulate(kDrive, 40, 200ms, noise, 2), noise, {}).newest();
  EXPECT_LT((newest.map_T_imu.translation.head<2>() - Eigen::Vector2d(8.962479621294856, 1.265676511241821)).norm(),
            1e-6);
}

TEST(FixedLagSmoother, isBetterThanItsMeasurements)
{
  const DriveNoise noise;
  double estimated = 0, measured = 0;
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    const SimulatedDrive drive = simulate(kDrive, 20, 200ms, noise, seed);
    const NavState& truth = drive.truth.back();
    estimated += boxMinus(run(drive, noise, {}).newest(), truth).head<3>().squaredNorm();
    measured += boxMinus(drive.map_T_body.back() * kBodyFromImu, truth.map_T_imu).head<3>().squaredNorm();
  }
  EXPECT_LT(estimated, 0.7 * measured);
}

TEST(FixedLagSmoother, errorsAreAsLargeAsItsCovarianceSays)
{
  const DriveNoise noise;
  double nees = 0, pose_nees = 0;
  constexpr int kRuns = 100;
  for (unsigned seed = 100; seed < 100 + kRuns; ++seed)
  {
    const SimulatedDrive drive = simulate(kDrive, 25, 200ms, noise, seed);
    const FixedLagSmoother smoother = run(drive, noise, withoutHuber(8));
    const Vector15d error = boxMinus(drive.truth.back(), smoother.newest());
    const Matrix15d covariance = smoother.newestCovariance();
    const Matrix6d pose_covariance = covariance.topLeftCorner<6, 6>();
    nees += error.dot(solveSymmetric(covariance, error)) / kRuns;
    pose_nees += error.head<6>().dot(solveSymmetric(pose_covariance, error.head<6>())) / kRuns;
  }
  // Chi-square over 100 runs: three standard deviations of the mean are 1.65 of 15 and 1.04 of 6.
  EXPECT_NEAR(nees, 15, 1.65) << "seeds from 100";
  EXPECT_NEAR(pose_nees, 6, 1.04) << "seeds from 100";
}

TEST(FixedLagSmoother, findsBiasesFarFromTheFirstGuess)
{
  // Beyond the reach of first order: the motions are integrated again on the way.
  DriveNoise noise;
  SimulatedDrive drive = simulate(kDrive, 50, 200ms, noise, 3);
  drive.first_guess.bias.gyro += Eigen::Vector3d(0.03, -0.02, 0.04);
  drive.first_guess.bias.accel += Eigen::Vector3d(0.2, 0.1, -0.3);
  drive.first_covariance.diagonal().segment<3>(9).setConstant(0.05 * 0.05);
  drive.first_covariance.diagonal().tail<3>().setConstant(0.3 * 0.3);
  for (Preintegration& m : drive.motions) m = preintegrate(m.samples, drive.first_guess.bias, noise.imu);

  const NavState end = run(drive, noise, {}).newest();
  EXPECT_LT((end.bias.gyro - drive.truth.back().bias.gyro).norm(), 2e-3);
  EXPECT_LT((end.bias.accel - drive.truth.back().bias.accel).norm(), 0.05);
}

TEST(FixedLagSmoother, givesTheSameBitsTwice)
{
  const DriveNoise noise;
  const SimulatedDrive drive = simulate(kDrive, 20, 100ms, noise, 4);
  const FixedLagSmoother a = run(drive, noise, {}), b = run(drive, noise, {});
  for (std::size_t k = 0; k < a.states().size(); ++k)
  {
    EXPECT_EQ(blocksOf(a.states()[k]).pose, blocksOf(b.states()[k]).pose);
    EXPECT_EQ(blocksOf(a.states()[k]).motion, blocksOf(b.states()[k]).motion);
  }
  EXPECT_EQ(a.newestCovariance(), b.newestCovariance());
}

TEST(FixedLagSmoother, keepsAsManyStatesAsItsWindow)
{
  const DriveNoise noise;
  const SimulatedDrive drive = simulate(kDrive, 20, 100ms, noise, 5);
  const FixedLagSmoother smoother = run(drive, noise, withoutHuber(6));
  EXPECT_EQ(smoother.states().size(), 6u);
  EXPECT_EQ(smoother.newest().stamp, drive.truth.back().stamp);
  EXPECT_EQ(smoother.states().front().stamp, drive.truth[14].stamp);
}

TEST(FixedLagSmoother, predictsWhatNoLidarPoseFollows)
{
  const DriveNoise noise;
  const SimulatedDrive drive = simulate(kDrive, 20, 100ms, noise, 6);
  FixedLagSmoother smoother = run(drive, noise, {});
  const double before = smoother.newestCovariance().diagonal().head<3>().sum();
  const Timestamp end = smoother.newest().stamp;
  const auto samples = kDrive.samples(end, end + 1s, 5ms, smoother.newest().bias);
  const Preintegration motion = preintegrate(samples, smoother.newest().bias, noise.imu);
  const NavState predicted = predict(smoother.newest(), motion);
  smoother.addState(motion);
  EXPECT_LT(boxMinus(smoother.optimise(), predicted).norm(), 1e-6);
  EXPECT_GT(smoother.newestCovariance().diagonal().head<3>().sum(), before);
}

TEST(FixedLagSmoother, letsTheImuCarryDirectionsWithoutInformation)
{
  // A corridor along the map's x: the lidar knows nothing of the way along it.
  const DriveNoise noise;
  SimulatedDrive drive = simulate(straightDrive(), 15, 100ms, noise, 7);
  FixedLagSmoother smoother = smootherFor(drive, noise, {});
  for (std::size_t k = 1; k < drive.truth.size(); ++k)
  {
    const Eigen::Vector3d along = drive.map_T_body[k].rotation.conjugate() * Eigen::Vector3d::UnitX();
    const Eigen::Vector3d wrong = Eigen::Vector3d::UnitX() * 20;
    Matrix6d information = drive.information;
    information.topLeftCorner<3, 3>() = 2500 * (Eigen::Matrix3d::Identity() - along * along.transpose());
    smoother.addState(drive.motions[k - 1]);
    smoother.addPosePrior({drive.map_T_body[k].rotation, drive.map_T_body[k].translation + wrong}, information);
    smoother.optimise();
  }
  const Eigen::Vector3d error = smoother.newest().map_T_imu.translation - drive.truth.back().map_T_imu.translation;
  EXPECT_LT(error.tail<2>().norm(), 0.05);
  EXPECT_LT(std::abs(error.x()), 0.5);  // the first state's 0.05 m and 0.1 m/s over 1.4 s
  const Matrix15d covariance = smoother.newestCovariance();
  const Eigen::Matrix3d in_map = smoother.newest().map_T_imu.rotation *
                                 Eigen::Matrix3d(covariance.topLeftCorner<3, 3>()) *
                                 smoother.newest().map_T_imu.rotation.conjugate().toRotationMatrix();
  EXPECT_GT(in_map(0, 0), 10 * in_map(1, 1));
}

TEST(FixedLagSmoother, tiesAStateToAnOlderOneInTheWindow)
{
  const DriveNoise noise;
  const SimulatedDrive drive = simulate(kDrive, 12, 200ms, noise, 8);
  FixedLagSmoother smoother = smootherFor(drive, noise, withoutHuber(5));
  const Matrix6d sharp = 1e8 * Matrix6d::Identity();  // 0.1 mm and 0.1 mrad
  const auto bodyOf = [&](std::size_t k) { return drive.truth[k].map_T_imu * kBodyFromImu.inverse(); };
  for (std::size_t k = 1; k < drive.truth.size(); ++k)
  {
    smoother.addState(drive.motions[k - 1]);
    const std::size_t reference = k < 3 ? 0 : k - 3;  // each is forgotten two scans later, with what hangs on it
    smoother.addRelativePose(drive.truth[reference].stamp, bodyOf(reference).inverse() * bodyOf(k), sharp);
    smoother.optimise();
    EXPECT_TRUE(smoother.report().usable);
  }
  const Rigid first_T_newest = smoother.states().front().map_T_imu.inverse() * smoother.newest().map_T_imu;
  const Rigid expected = drive.truth[7].map_T_imu.inverse() * drive.truth[11].map_T_imu;
  EXPECT_LT(boxMinus(first_T_newest, expected).norm(), 1e-3);
}

namespace
{
/** Every lidar pose is measured from the second state, as long as the smoother keeps it. */
FixedLagSmoother runFromAnchor(const SimulatedDrive& drive, const DriveNoise& noise, const SmootherOptions& options,
                               bool optimise_always = true)
{
  FixedLagSmoother smoother = smootherFor(drive, noise, options);
  for (std::size_t k = 1; k < drive.truth.size(); ++k)
  {
    smoother.addState(drive.motions[k - 1]);
    if (k == 1) smoother.anchorNewest();
    if (k > 1)
      smoother.addRelativePose(drive.truth[1].stamp, drive.map_T_body[1].inverse() * drive.map_T_body[k],
                               drive.information);
    if (optimise_always || k + 1 == drive.truth.size()) smoother.optimise();
  }
  return smoother;
}
}  // namespace

TEST(FixedLagSmoother, keepsItsAnchorBeyondTheWindow)
{
  const DriveNoise noise;
  const SimulatedDrive drive = simulate(kDrive, 20, 200ms, noise, 21);
  const FixedLagSmoother smoother = runFromAnchor(drive, noise, withoutHuber(5));
  ASSERT_EQ(smoother.states().size(), 6u);
  EXPECT_EQ(smoother.states()[0].stamp, drive.truth[1].stamp);
  EXPECT_EQ(smoother.states()[1].stamp, drive.truth[15].stamp);
  EXPECT_EQ(smoother.anchor().stamp, drive.truth[1].stamp);
}

TEST(FixedLagSmoother, withAnAnchorEqualsTheBatchWhereTheProblemIsLinear)
{
  DriveNoise noise;
  noise.share = 1e-6;
  const SimulatedDrive drive = simulate(straightDrive(), 20, 200ms, noise, 22);
  const NavState windowed = runFromAnchor(drive, noise, withoutHuber(4)).newest();
  const NavState batch = runFromAnchor(drive, noise, withoutHuber(20, 30), false).newest();
  EXPECT_LT(boxMinus(windowed, batch).norm(), 1e-9);
}

TEST(FixedLagSmoother, bodySeenFromTheAnchorIsAsFarOffAsItsCovarianceSays)
{
  // The anchor's own measured pose is exact here, so that errors of different scans are independent.
  const DriveNoise noise;
  double nees = 0, largest = 0;
  constexpr int kRuns = 100;
  for (unsigned seed = 300; seed < 300 + kRuns; ++seed)
  {
    SimulatedDrive drive = simulate(kDrive, 25, 200ms, noise, seed);
    drive.map_T_body[1] = drive.truth[1].map_T_imu * kBodyFromImu.inverse();
    const FixedLagSmoother smoother = runFromAnchor(drive, noise, withoutHuber(8));
    const auto seen = [](const NavState& from, const NavState& to)
    { return (from.map_T_imu * kBodyFromImu.inverse()).inverse() * (to.map_T_imu * kBodyFromImu.inverse()); };
    const Vector6d error =
        boxMinus(seen(drive.truth[1], drive.truth.back()), seen(smoother.anchor(), smoother.newest()));
    const Matrix6d covariance = smoother.newestBodyCovariance();
    nees += error.dot(solveSymmetric(covariance, error)) / kRuns;
    largest = std::max(largest, covariance.diagonal().head<3>().sum());
  }
  EXPECT_NEAR(nees, 6, 1.04) << "seeds from 300";
  EXPECT_LT(std::sqrt(largest), 2 * noise.pose);  // however uncertain the map is that both are in
}

TEST(FixedLagSmoother, tellsWhatALidarPoseLeavesOfTheCovarianceWithoutComputingItAnew)
{
  const DriveNoise noise;
  const SimulatedDrive drive = simulate(kDrive, 25, 200ms, noise, 31);
  for (const bool anchored : {false, true})
    for (const double off : {0.0, 0.5})  // m: the second is beyond the robust loss's reach
    {
      FixedLagSmoother smoother = smootherFor(drive, noise, {});
      for (std::size_t k = 1; k < drive.truth.size(); ++k)
      {
        smoother.addState(drive.motions[k - 1]);
        const bool last = k + 1 == drive.truth.size();
        const Rigid map_T_body =
            boxPlus(drive.map_T_body[k], last ? Vector6d(off * Vector6d::Unit(1)) : Vector6d::Zero());
        const Matrix6d before = smoother.newestBodyCovariance();
        if (smoother.hasAnchor())
          smoother.addRelativePose(smoother.anchor().stamp, drive.map_T_body[1].inverse() * map_T_body,
                                   drive.information);
        else
          smoother.addPosePrior(map_T_body, drive.information);
        smoother.optimise();
        if (anchored && k == 1) smoother.anchorNewest();
        if (!last) continue;
        const Matrix6d computed = smoother.newestBodyCovariance(), told = smoother.bodyCovarianceAfter(before);
        EXPECT_LT((told - computed).norm(), 0.02 * computed.norm()) << anchored << ' ' << off;
        EXPECT_GT((before - computed).norm(), 0.06 * computed.norm()) << anchored << ' ' << off;
      }
    }
}

namespace
{
const Matrix6d kStep = (Vector6d() << 0.01, 0.02, 0.01, 1e-3, 1e-3, 2e-3).finished().cwiseAbs2().asDiagonal();

/** Of the pose seen from the anchor, by which it is known less well after loosenAnchor(kStep). */
Matrix6d loosened(FixedLagSmoother smoother)
{
  const Matrix6d before = smoother.newestBodyCovariance();
  smoother.loosenAnchor(kStep);
  return smoother.newestBodyCovariance() - before;
}
}  // namespace

TEST(FixedLagSmoother, aStepOfItsAnchorIsAllThatChanges)
{
  const DriveNoise noise;
  const SimulatedDrive drive = simulate(kDrive, 12, 200ms, noise, 42);
  for (const std::size_t scans : {4u, 12u})  // the anchor is in the window, and behind it
  {
    SimulatedDrive begin = drive;
    begin.truth.resize(scans);
    FixedLagSmoother smoother = runFromAnchor(begin, noise, withoutHuber(6));
    const Rigid anchor_T_body = smoother.anchorBody().inverse() * smoother.newestBody();
    EXPECT_LT((loosened(smoother) - movedTo(anchor_T_body, kStep)).norm(), 0.01 * kStep.norm()) << scans;
    const NavState before = smoother.newest();
    const Matrix15d covariance = smoother.newestCovariance();
    smoother.loosenAnchor(kStep);
    EXPECT_LT((smoother.newestCovariance() - covariance).norm(), 1e-6 * covariance.norm()) << scans;
    EXPECT_LT(boxMinus(smoother.optimise(), before).norm(), 1e-4) << scans;
  }
}

TEST(FixedLagSmoother, refusesAStepOfAnAnchorThatIsNotBehind)
{
  const DriveNoise noise;
  const SimulatedDrive drive = simulate(kDrive, 5, 200ms, noise, 43);
  FixedLagSmoother smoother = smootherFor(drive, noise, {});
  EXPECT_THROW(smoother.loosenAnchor(kStep), std::invalid_argument);
  smoother.addState(drive.motions[0]);
  smoother.anchorNewest();
  EXPECT_THROW(smoother.loosenAnchor(kStep), std::invalid_argument);
  smoother.addState(drive.motions[1]);
  EXPECT_NO_THROW(smoother.loosenAnchor(kStep));
}

TEST(FixedLagSmoother, errorsAreAsLargeAsItsCovarianceSaysWhereTheAnchorCreeps)
{
  const DriveNoise noise;
  double with_steps = 0, without = 0;
  constexpr int kRuns = 100;
  for (unsigned seed = 500; seed < 500 + kRuns; ++seed)
    for (const bool told : {true, false})
    {
      const SimulatedDrive drive = simulate(kDrive, 60, 200ms, noise, seed);
      Noise random(seed);
      FixedLagSmoother smoother = smootherFor(drive, noise, withoutHuber(4));
      Rigid anchor = drive.truth[1].map_T_imu * kBodyFromImu.inverse();  // where the map takes it to be
      for (std::size_t k = 1; k < drive.truth.size(); ++k)
      {
        smoother.addState(drive.motions[k - 1]);
        if (k == 1) smoother.anchorNewest();
        if (k > 1)
          smoother.addRelativePose(drive.truth[1].stamp, anchor.inverse() * drive.map_T_body[k], drive.information);
        smoother.optimise();
        if (k % 10 != 0) continue;
        anchor = boxPlus(anchor, Vector6d(kStep.diagonal().cwiseSqrt().cwiseProduct(random.normal<6>(1))));
        if (told) smoother.loosenAnchor(kStep);
      }
      const Vector15d error = boxMinus(drive.truth.back(), smoother.newest());
      (told ? with_steps : without) += error.dot(solveSymmetric(smoother.newestCovariance(), error)) / kRuns;
    }
  EXPECT_NEAR(with_steps, 15, 1.65) << "seeds from 500";
  EXPECT_GT(without, 30);
}

TEST(FixedLagSmoother, resistsAnOutlier)
{
  const DriveNoise noise;
  const SimulatedDrive drive = simulate(kDrive, 20, 100ms, noise, 9);
  const auto errorWith = [&](double huber)
  {
    FixedLagSmoother smoother = smootherFor(drive, noise, with(&SmootherOptions::huber, huber));
    for (std::size_t k = 1; k < drive.truth.size(); ++k)
    {
      smoother.addState(drive.motions[k - 1]);
      Rigid pose = drive.map_T_body[k];
      if (k == 15) pose.translation += Eigen::Vector3d(2, -1, 0.5);
      smoother.addPosePrior(pose, drive.information);
      smoother.optimise();
    }
    return boxMinus(smoother.newest(), drive.truth.back()).head<3>().norm();
  };
  EXPECT_LT(errorWith(4), 0.1);
  EXPECT_GT(errorWith(0), 3 * errorWith(4));
}

TEST(FixedLagSmoother, survivesGarbageWithoutANaN)
{
  const DriveNoise noise;
  const SimulatedDrive drive = simulate(kDrive, 40, 100ms, noise, 10);
  FixedLagSmoother smoother = smootherFor(drive, noise, {});
  const Rigid far{Eigen::Quaterniond::Identity(), {1e8, -1e8, 1e8}};
  const Rigid upside_down = Rigid::fromXyzYawPitchRoll(0, 0, 0, 0, 0, M_PI);
  const Rigid broken{Eigen::Quaterniond(NAN, 0, 0, 0), {0, 0, 0}};
  const Rigid not_a_rotation{Eigen::Quaterniond(0, 0, 0, 0), {0, 0, 0}};
  Matrix6d nan = Matrix6d::Identity();
  nan(1, 2) = NAN;
  Matrix6d indefinite = Matrix6d::Identity();
  indefinite(0, 0) = -1e6;
  for (std::size_t k = 1; k < drive.truth.size(); ++k)
  {
    smoother.addState(drive.motions[k - 1]);
    const Rigid& good = drive.map_T_body[k];
    if (k % 10 == 1) smoother.addPosePrior(far, 1e15 * Matrix6d::Identity());
    if (k % 10 == 2) smoother.addPosePrior(upside_down, 1e10 * Matrix6d::Identity());
    if (k % 10 == 3) smoother.addPosePrior(broken, drive.information);
    if (k % 10 == 4) smoother.addPosePrior(not_a_rotation, drive.information);
    if (k % 10 == 5) smoother.addPosePrior(good, nan);
    if (k % 10 == 6) smoother.addPosePrior(good, indefinite);
    if (k % 10 == 7) smoother.addPosePrior(good, Matrix6d::Zero());
    if (k % 10 == 8) smoother.addPosePrior(good, 1e300 * Matrix6d::Identity());
    const NavState state = smoother.optimise();
    EXPECT_TRUE(state.allFinite()) << k;
    EXPECT_NEAR(state.map_T_imu.rotation.norm(), 1, 1e-9);
    EXPECT_TRUE(isFiniteAndSymmetric(smoother.newestCovariance())) << k;
  }
  EXPECT_EQ(smoother.report().refused, 16);
}

TEST(FixedLagSmoother, refusesAMotionThatDoesNotFollowOrDoesNotLast)
{
  const DriveNoise noise;
  const SimulatedDrive drive = simulate(kDrive, 3, 100ms, noise, 11);
  FixedLagSmoother smoother = smootherFor(drive, noise, {});
  EXPECT_THROW(smoother.addState(drive.motions[1]), std::invalid_argument);

  Preintegration empty;
  empty.from = empty.to = drive.truth[0].stamp;
  EXPECT_THROW(smoother.addState(empty), std::invalid_argument);

  Preintegration broken = drive.motions[0];
  broken.delta.velocity.x() = NAN;
  EXPECT_THROW(smoother.addState(broken), std::invalid_argument);

  smoother.addState(drive.motions[0]);
  EXPECT_THROW(smoother.addState(drive.motions[0]), std::invalid_argument);
  EXPECT_THROW(smoother.addRelativePose(Timestamp{0s}, {}, Matrix6d::Identity()), std::invalid_argument);
  EXPECT_THROW(smoother.addRelativePose(smoother.newest().stamp, {}, Matrix6d::Identity()), std::invalid_argument);
  EXPECT_EQ(smoother.states().size(), 2u);
}

TEST(FixedLagSmoother, refusesAStartWithoutAProperCovariance)
{
  const NavState state = kDrive.stateAt(Timestamp{1s});
  const auto start = [](const NavState& s, const Matrix15d& covariance, int window = 8)
  { return FixedLagSmoother(s, covariance, kBodyFromImu, {}, withoutHuber(window)); };

  EXPECT_NO_THROW(start(state, Matrix15d::Identity()));
  EXPECT_THROW(start(state, Matrix15d::Zero()), std::invalid_argument);
  EXPECT_THROW(start(state, -Matrix15d::Identity()), std::invalid_argument);
  EXPECT_THROW(start(state, Matrix15d::Constant(NAN)), std::invalid_argument);
  EXPECT_THROW(start(state, Matrix15d::Identity(), 1), std::invalid_argument);
  NavState broken = state;
  broken.velocity.x() = INFINITY;
  EXPECT_THROW(start(broken, Matrix15d::Identity()), std::invalid_argument);
}

TEST(FixedLagSmoother, reportsWhatTheSolverDid)
{
  const DriveNoise noise;
  const SimulatedDrive drive = simulate(kDrive, 10, 100ms, noise, 12);
  const SmootherReport report = run(drive, noise, {}).report();
  EXPECT_TRUE(report.usable);
  EXPECT_TRUE(report.converged);
  EXPECT_GE(report.iterations, 1);
  EXPECT_LE(report.final_cost, report.initial_cost);
}
}  // namespace scanloom::fixed_lag_smoother_unittest
