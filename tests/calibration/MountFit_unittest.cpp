/** How far apart surfaces are, at the right pose and at wrong ones, on a drive among stems. */
#include "calibration/internal/MountFit.h"

#include "base/core/Interruption.h"
#include "calibration/driveOfTwo.h"

#include <gtest/gtest.h>

#include <csignal>

namespace scanloom::mount_fit_unittest
{
namespace
{
std::vector<Station> stationsOn(const DriveOfTwo& drive)
{
  return stationsOf(drive.right, drive.left, {kLeft, 0}, drive.trajectory, {5});
}
}  // namespace

TEST(MountFit, ofTheRightPoseIsAsCloseAsTheReferenceIsToItself)
{
  const DriveOfTwo drive = driven(1);
  const std::vector<Station> stations = stationsOn(drive);
  const double within = distanceWithinReference(stations);
  EXPECT_GT(within, 0);
  EXPECT_LT(mountFit(stations, {kRight, 0}, drive.trajectory).distance, 1.3 * within);
}

TEST(MountFit, ofAPoseTurnedByThirtyDegreesIsFartherThanTheReferenceIsToItself)
{
  const DriveOfTwo drive = driven(1);
  const std::vector<Station> stations = stationsOn(drive);
  Rigid turned = kRight;
  turned.rotation = Eigen::AngleAxisd(30 * kDegree, Eigen::Vector3d::UnitZ()) * turned.rotation;
  EXPECT_GT(mountFit(stations, {turned, 0}, drive.trajectory).distance, 2 * distanceWithinReference(stations));
}

TEST(MountFit, endsAtOnceWhenInterrupted)
{
  const DriveOfTwo drive = driven(1);
  const std::vector<Station> stations = stationsOn(drive);
  std::signal(SIGTERM, SIG_DFL);
  catchUnhandledInterruption();
  std::raise(SIGTERM);
  EXPECT_THROW(mountFit(stations, {kRight, 0}, drive.trajectory), Interrupted);

  catchUnhandledInterruption();  // clears it
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGINT, SIG_DFL);
}
}  // namespace scanloom::mount_fit_unittest
