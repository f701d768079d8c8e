#include "calibration/ScansOfDrive.h"

#include "base/core/So3.h"
#include "calibration/OwnParts.h"
#include "calibration/internal/Stations.h"
#include "calibration/internal/someOf.h"

#include <utility>

namespace scanloom
{
namespace
{
PointCloud cloudOf(const LidarScan& scan, const Rigid& frame_T_sensor)
{
  PointCloud cloud;
  cloud.resize(scan.points.size());
  for (std::size_t k = 0; k < scan.points.size(); ++k)
  {
    const Eigen::Vector3f p = (frame_T_sensor * scan.points[k].cast<double>()).cast<float>();
    cloud.x[k] = p.x(), cloud.y[k] = p.y(), cloud.z[k] = p.z();
  }
  return cloud;
}

LidarScan without(const OwnParts& parts, const LidarScan& scan)
{
  LidarScan rest{scan.start, scan.period, {}, {}};
  for (std::size_t i = 0; i < scan.points.size(); ++i)
    if (!parts.holds(scan.points[i]))
    {
      rest.points.push_back(scan.points[i]);
      rest.t.push_back(scan.t[i]);
    }
  return rest;
}
}  // namespace

std::optional<GroundPlane> groundOf(const std::vector<LidarScan>& scans, const Rigid& body_T_sensor,
                                    const Eigen::Vector3d& up_in_body)
{
  constexpr std::size_t kScans = 10;
  const Rigid level_T_body{rotationBetween(up_in_body, Eigen::Vector3d::UnitZ()), Eigen::Vector3d::Zero()};
  const Rigid level_T_sensor = level_T_body * body_T_sensor;
  std::vector<PointCloud> clouds;
  for (const LidarScan& scan : someOf(scans, kScans)) clouds.push_back(cloudOf(scan, level_T_sensor));
  std::vector<const PointCloud*> pointers;
  for (const PointCloud& cloud : clouds) pointers.push_back(&cloud);
  std::optional<GroundPlane> ground = groundPlane(pointers, level_T_sensor.translation);
  if (ground) ground->up = level_T_body.rotation.conjugate() * ground->up;
  return ground;
}

std::vector<LidarScan> withoutOwnParts(std::vector<LidarScan> scans, const Trajectory& trajectory,
                                       const Eigen::Vector3d& up_in_lidar)
{
  constexpr double kReachOfMachine = 5;  // m
  constexpr std::size_t kFewestPlaces = 8, kMostPlaces = 20;
  const std::vector<const LidarScan*> places = someOf(scansApart(scans, trajectory), kMostPlaces);
  if (places.size() < kFewestPlaces) return scans;
  OwnParts parts(groundOf(scans, Rigid::identity(), up_in_lidar), kReachOfMachine);
  for (const LidarScan* place : places) parts.addPlace(cloudOf(*place, Rigid::identity()));
  std::vector<LidarScan> rest;
  for (LidarScan& scan : scans)
  {
    scan = without(parts, scan);  // one at a time: all scans of a drive fill memory once
    if (!scan.points.empty()) rest.push_back(std::move(scan));
  }
  return rest;
}
}  // namespace scanloom
