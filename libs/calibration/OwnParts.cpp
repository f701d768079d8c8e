#include "calibration/OwnParts.h"

#include "base/core/So3.h"
#include "calibration/internal/CubesInPlace.h"
#include "calibration/internal/Stations.h"

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr double kPartReach = 5, kPartCube = 0.25, kAboveGround = 0.4;  // m
constexpr double kAlmostAlways = 0.75;                                  // of the places
constexpr std::size_t kFewestToTellParts = 8, kMostToTellParts = 20;

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

/** What stays in place, by scans at several places. */
class Parts
{
 public:
  Parts(const std::vector<const LidarScan*>& places, const std::optional<GroundPlane>& ground) : ground_(ground)
  {
    for (const LidarScan* place : places) cubes_.add(place->points);
  }

  bool include(const Eigen::Vector3f& p) const
  {
    return isNear(p) && cubes_.cloudsAt(p) >= kAlmostAlways * cubes_.clouds();
  }

 private:
  bool isNear(const Eigen::Vector3f& p) const
  {
    return p.norm() < kPartReach &&
           !(ground_ && std::abs(ground_->up.dot(p.cast<double>()) + ground_->body_height) < kAboveGround);
  }
  std::optional<GroundPlane> ground_;
  CubesInPlace cubes_{kPartCube};
};

LidarScan without(const Parts& parts, const LidarScan& scan)
{
  LidarScan rest{scan.start, scan.period, {}, {}};
  for (std::size_t i = 0; i < scan.points.size(); ++i)
    if (!parts.include(scan.points[i]))
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
  for (std::size_t i = 0; i < std::min(kScans, scans.size()); ++i)
    clouds.push_back(cloudOf(scans[i * scans.size() / kScans % scans.size()], level_T_sensor));
  std::vector<const PointCloud*> pointers;
  for (const PointCloud& cloud : clouds) pointers.push_back(&cloud);
  std::optional<GroundPlane> ground = groundPlane(pointers, level_T_sensor.translation);
  if (ground) ground->up = level_T_body.rotation.conjugate() * ground->up;
  return ground;
}

std::vector<LidarScan> withoutOwnParts(std::vector<LidarScan> scans, const Trajectory& trajectory,
                                       const Eigen::Vector3d& up_in_lidar)
{
  const std::vector<const LidarScan*> all = scansApart(scans, trajectory);
  if (all.size() < kFewestToTellParts) return scans;
  std::vector<const LidarScan*> places;
  const std::size_t count = std::min(kMostToTellParts, all.size());
  for (std::size_t i = 0; i < count; ++i) places.push_back(all[i * all.size() / count]);
  const Parts parts(places, groundOf(scans, Rigid::identity(), up_in_lidar));
  std::vector<LidarScan> rest;
  for (LidarScan& scan : scans)
  {
    scan = without(parts, scan);  // one at a time: all scans of a drive fill memory once
    if (!scan.points.empty()) rest.push_back(std::move(scan));
  }
  return rest;
}
}  // namespace scanloom
