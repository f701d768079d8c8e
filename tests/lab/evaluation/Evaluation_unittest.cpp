#include "lab/evaluation/Evaluation.h"
#include "base/positions/TotalStation.h"

#include "base/formats/Trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/TestData.h"
#include "support/with.h"

namespace scanloom::evaluation_unittest
{
namespace
{
/** 20 m along x in 20 s; from the fifth on the machine rises by `height` m between whole seconds. */
Trajectory bobbing(double height, Duration step)
{
  Trajectory trajectory;
  for (Duration t{0}; t <= 20s; t += step)
  {
    const double z = t < 5s ? 0 : height * std::pow(std::sin(M_PI * seconds(t)), 2);
    trajectory.push_back({Timestamp{t}, {Eigen::Quaterniond::Identity(), {seconds(t), 0, z}}});
  }
  return trajectory;
}

TEST(Evaluation, tellsWhatInterpolationAloneCosts)
{
  EvaluationInput input;
  input.scans = bobbing(0, 1s);
  input.imu_rate = bobbing(0.4, 10ms);
  input.reference = bobbing(0.4, 10ms);

  const Evaluation evaluation = evaluate(input, {});

  // The truth known at whole seconds is a level line, as the estimate is.
  EXPECT_NEAR(evaluation.floor->largest, 0.4, 1e-12);
  EXPECT_DOUBLE_EQ(evaluation.drift.largest, evaluation.floor->largest);
  EXPECT_LT(evaluation.imu_rate_drift->largest, 1e-12);
  EXPECT_LT(evaluation.absolute.metres.rmse, 1e-12);  // at the scans' stamps
}

TEST(Evaluation, usesStampsAsGivenUnlessAskedNotTo)
{
  EvaluationInput input;
  input.scans = bobbing(0.4, 10ms);
  Trajectory late = bobbing(0.4, 10ms);
  for (StampedPose& pose : late) pose.stamp += 100ms;
  input.reference = late;

  const Evaluation as_given = evaluate(input, {});
  EXPECT_NEAR(seconds(*as_given.clock_offset), 0.1, 1e-3);
  EXPECT_FALSE(as_given.clock_offset_applied);
  EXPECT_GT(as_given.drift.largest, 0.1);

  const Evaluation applied = evaluate(input, with(&EvaluationOptions::apply_clock_offset, true));
  EXPECT_TRUE(applied.clock_offset_applied);
  EXPECT_LT(applied.drift.largest, 1e-3);
  EXPECT_LT(applied.absolute.metres.rmse, 1e-3);
}

TEST(Evaluation, refusesTrajectoriesOfDifferentTimes)
{
  EvaluationInput input;
  input.scans = bobbing(0, 1s);
  input.reference = PositionTrack{{Timestamp{1h}, {0, 0, 0}}};

  EXPECT_THROW(evaluate(input, {}), std::invalid_argument);
}

/** By a script that shares no code with this project: bisection, slerp, Horn's quaternion for SE(3). */
struct ByScript
{
  AlignmentKind alignment;
  double drift, final, ape;
};

TEST(Evaluation, givesTheFiguresOfAnIndependentScript)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  EvaluationInput input;
  input.scans = readTum(recording / "groundtruth.tum");
  input.reference = readTotalStation(recording / "total_station.csv");
  EvaluationOptions options;
  options.body_p_point = {-1.1, 0.55, 3.95};

  for (const ByScript& expected : {ByScript{AlignmentKind::Yaw, 0.0106713751260, 0.0081100250909, 0.0034538663695},
                                   ByScript{AlignmentKind::Se3, 0.0116305538986, 0.0066905934746, 0.0034483697547}})
  {
    options.alignment = expected.alignment;
    const Evaluation evaluation = evaluate(input, options);

    EXPECT_NEAR(evaluation.drift.largest, expected.drift, 1e-9);
    EXPECT_NEAR(evaluation.drift.final, expected.final, 1e-9);
    EXPECT_NEAR(evaluation.absolute.metres.rmse, expected.ape, 1e-9);
    EXPECT_NEAR(evaluation.drift.path_length, 16.2535008544, 1e-9);
    EXPECT_EQ(evaluation.drift.fitted, 39U);
    EXPECT_EQ(evaluation.drift.samples, 195U);
  }
}
}  // namespace
}  // namespace scanloom::evaluation_unittest
