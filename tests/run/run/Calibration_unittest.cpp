#include "run/run/Calibration.h"

#include <gtest/gtest.h>

namespace scanloom::calibration_unittest
{
namespace
{
TEST(Calibration, ofALidarThatSawOnlyTheMachineIsNotThatOfAMachineAtRest)
{
  CalibrationDrive drive;
  drive.scans.resize(2);
  for (int i = 0; i < 20; ++i)
  {
    const Timestamp stamp{i * 100ms};
    drive.trajectory.push_back({stamp, {Eigen::Quaterniond::Identity(), {i * 1.0, 0, 0}}});
    drive.scans[0].push_back({stamp, 100ms, {{5, 0, 0}}, {0}});
  }
  const std::vector<MountedLidar> lidars{{"left", {}}, {"right", {}}};

  const LidarCalibration covered = calibrateLidar(1, lidars, 0, drive, Clock::Kept, PoseGiven::Within20Degrees);
  EXPECT_EQ(covered.estimate.outcome, ExtrinsicsOutcome::NothingShared);
}
}  // namespace
}  // namespace scanloom::calibration_unittest
