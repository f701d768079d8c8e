/** How far apart surfaces are, at the right pose and at wrong ones, on a drive among stems. */
#include "calibration/internal/ExtrinsicsFit.h"

#include "base/core/Interruption.h"
#include "calibration/driveOfTwo.h"

#include <gtest/gtest.h>

#include <csignal>

namespace scanloom::extrinsics_fit_unittest
{
namespace
{
std::vector<Station> stationsOn(const DriveOfTwo& drive)
{
  return stationsOf(drive.right, drive.left, {kLeft, 0}, drive.trajectory, {5});
}
}  // namespace

TEST(ExtrinsicsFit, ofTheRightPoseIsAsCloseAsTheReferenceIsToItself)
{
  const DriveOfTwo drive = driven(1);
  const std::vector<Station> stations = stationsOn(drive);
  const double within = distanceWithinReference(stations);
  EXPECT_GT(within, 0);
  EXPECT_LT(extrinsicsFit(stations, {kRight, 0}, drive.trajectory).distance, 1.3 * within);
}

TEST(ExtrinsicsFit, ofAPoseTurnedByThirtyDegreesIsFartherThanTheReferenceIsToItself)
{
  const DriveOfTwo drive = driven(1);
  const std::vector<Station> stations = stationsOn(drive);
  Rigid turned = kRight;
  turned.rotation = Eigen::AngleAxisd(30 * kDegree, Eigen::Vector3d::UnitZ()) * turned.rotation;
  EXPECT_GT(extrinsicsFit(stations, {turned, 0}, drive.trajectory).distance, 2 * distanceWithinReference(stations));
}

TEST(ExtrinsicsFit, endsAtOnceWhenInterrupted)
{
  const DriveOfTwo drive = driven(1);
  const std::vector<Station> stations = stationsOn(drive);
  std::signal(SIGTERM, SIG_DFL);
  catchUnhandledInterruption();
  std::raise(SIGTERM);
  EXPECT_THROW(extrinsicsFit(stations, {kRight, 0}, drive.trajectory), Interrupted);

  catchUnhandledInterruption();  // clears it
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGINT, SIG_DFL);
}
}  // namespace scanloom::extrinsics_fit_unittest
