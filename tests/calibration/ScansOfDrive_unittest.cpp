/** The parts of the machine in a lidar's scans, among walls and ground that are known. */
#include "calibration/ScansOfDrive.h"

#include "calibration/seenInWorld.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace scanloom::scans_of_drive_unittest
{
namespace
{
const Rigid kOnBody = at(0, 0, 2);
const Eigen::Vector3f kPart(-1.5F, 0.3F, -0.6F);  // m, in the lidar's frame

/** Twelve scans of a forest, `step` (m) apart, with a part of the machine in each. */
struct DriveWithPart
{
  std::vector<LidarScan> scans;
  Trajectory trajectory;
};

DriveWithPart driven(double step)
{
  DriveWithPart drive;
  for (int i = 0; i <= 12; ++i)
  {
    const Rigid map_T_body = at(step * i, 0, 0);
    drive.trajectory.push_back({Timestamp{i * 400ms}, map_T_body});
    LidarScan scan;
    scan.start = Timestamp{i * 400ms};
    scan.points = scanFrom(forest(1, 200), map_T_body * kOnBody, static_cast<std::uint64_t>(i), lidar());
    scan.points.push_back(kPart);
    scan.t.assign(scan.points.size(), 0);
    if (i < 12) drive.scans.push_back(std::move(scan));
  }
  return drive;
}

double pointsIn(const std::vector<LidarScan>& scans)
{
  double points = 0;
  for (const LidarScan& scan : scans) points += static_cast<double>(scan.points.size());
  return points;
}

bool showsPart(const LidarScan& scan)
{
  return std::find(scan.points.begin(), scan.points.end(), kPart) != scan.points.end();
}

std::vector<LidarScan> withoutParts(const DriveWithPart& drive)
{
  return withoutOwnParts(drive.scans, drive.trajectory, Eigen::Vector3d::UnitZ());
}
}  // namespace

TEST(OwnParts, areLeftOutAndNearlyNothingElse)
{
  const DriveWithPart drive = driven(1.5);
  const std::vector<LidarScan> rest = withoutParts(drive);
  EXPECT_TRUE(std::none_of(rest.begin(), rest.end(), &showsPart));
  EXPECT_GT(pointsIn(rest), 0.98 * pointsIn(drive.scans));
}

TEST(OwnParts, ofAMachineAtRestAreNotKnown)
{
  const DriveWithPart drive = driven(0);
  EXPECT_EQ(pointsIn(withoutParts(drive)), pointsIn(drive.scans));
}

TEST(OwnParts, leaveOutTheScansOfALidarThatSeesNothingElse)
{
  DriveWithPart drive = driven(1.5);
  for (std::size_t i = 0; i < drive.scans.size(); i += 2)
  {
    drive.scans[i].points = {kPart};
    drive.scans[i].t = {0};
  }
  EXPECT_EQ(withoutParts(drive).size(), drive.scans.size() / 2);
}
}  // namespace scanloom::scans_of_drive_unittest
