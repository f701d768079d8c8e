#include "calibration/GroundPlane.h"

#include "base/core/Decompositions.h"
#include "estimation/preprocessing/Thin.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

namespace scanloom
{
namespace
{
constexpr double kCube = 0.25;       // m
constexpr double kReach = 12;        // m: farther away forest ground is not flat
constexpr double kThickness = 0.15;  // m: roots and grass
constexpr int kTriples = 2000;       // misses a plane with a fifth of the points with probability 1e-7
constexpr int kRefinements = 4;
constexpr std::size_t kFewestPoints = 100;
constexpr double kLeastShare = 0.1;
const double kLevel = std::cos(35 * M_PI / 180), kUpright = std::cos(75 * M_PI / 180);

using Points = std::vector<Eigen::Vector3d>;

struct Plane
{
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit
  double offset = 0;                                  // normal . p = offset
  std::size_t points = 0;

  double distance(const Eigen::Vector3d& p) const { return normal.dot(p) - offset; }
};

Points pointsAround(const std::vector<const PointCloud*>& clouds, const Eigen::Vector3d& sensor)
{
  Points points;
  for (const PointCloud* cloud : clouds)
  {
    const PointCloud thinned = thin(*cloud, kCube);
    for (std::size_t i = 0; i < thinned.size(); ++i)
    {
      const Eigen::Vector3d p = thinned.position(i).cast<double>();
      if ((p - sensor).norm() < kReach) points.push_back(p);
    }
  }
  return points;
}

std::size_t pointsOn(const Plane& plane, const Points& points)
{
  std::size_t n = 0;
  for (const Eigen::Vector3d& p : points) n += std::abs(plane.distance(p)) < kThickness ? 1 : 0;
  return n;
}

std::optional<Plane> through(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  if (normal.norm() < 0.5) return std::nullopt;  // m2: nearly in a line or too near each other for a direction
  Plane plane;
  plane.normal = normal.normalized();
  plane.offset = plane.normal.dot(a);
  return plane;
}

/** The planes with most points. */
struct Found
{
  Plane any, below, above;  // the last two nearly level, below and above the sensor
};

Found search(const Points& points, const Eigen::Vector3d& sensor)
{
  std::mt19937 random(1);
  const auto draw = [&] { return points[random() % points.size()]; };
  Found found;
  for (int i = 0; i < kTriples; ++i)
  {
    const Eigen::Vector3d a = draw(), b = draw(), c = draw();
    std::optional<Plane> plane = through(a, b, c);
    if (!plane || std::abs(plane->distance(sensor)) < kThickness) continue;  // a level beam draws a plane of its own
    plane->points = pointsOn(*plane, points);
    if (plane->points > found.any.points) found.any = *plane;
    if (std::abs(plane->normal.z()) < kLevel) continue;
    Plane& level = plane->distance(sensor) * plane->normal.z() > 0 ? found.below : found.above;
    if (plane->points > level.points) level = *plane;
  }
  return found;
}

bool isGround(const Plane& plane, std::size_t points)
{
  return plane.points >= kFewestPoints &&
         static_cast<double>(plane.points) >= kLeastShare * static_cast<double>(points);
}

/** Under a ceiling the ground is the plane below the sensor, even if fewer points are on it. */
const Plane& groundAmong(const Found& found, std::size_t points)
{
  const Plane& level = isGround(found.below, points) ? found.below : found.above;
  return found.any.points > 2 * std::max(found.below.points, found.above.points) ? found.any : level;
}

Plane refined(const Plane& plane, const Points& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double n = 0;
  for (const Eigen::Vector3d& p : points)
  {
    if (std::abs(plane.distance(p)) >= kThickness) continue;
    sum += p;
    squares += p * p.transpose();
    ++n;
  }
  const Eigen::Vector3d mean = sum / n;
  Plane better;
  better.normal = eigensystem3(squares / n - mean * mean.transpose()).vectors.col(0);
  better.offset = better.normal.dot(mean);
  better.points = pointsOn(better, points);
  return better;
}
}  // namespace

std::optional<GroundPlane> groundPlane(const std::vector<const PointCloud*>& points_in_body,
                                       const Eigen::Vector3d& sensor_in_body)
{
  const Points points = pointsAround(points_in_body, sensor_in_body);
  if (points.size() < kFewestPoints) return std::nullopt;
  const Found found = search(points, sensor_in_body);
  Plane plane = groundAmong(found, points.size());
  if (plane.points < kFewestPoints) return std::nullopt;
  for (int i = 0; i < kRefinements; ++i) plane = refined(plane, points);
  if (!isGround(plane, points.size())) return std::nullopt;

  GroundPlane ground;
  ground.share = static_cast<double>(plane.points) / static_cast<double>(points.size());
  ground.may_be_a_wall = std::abs(plane.normal.z()) < kUpright &&
                         (isGround(found.below, points.size()) || isGround(found.above, points.size()));
  const double side = plane.distance(sensor_in_body) < 0 ? -1 : 1;
  ground.up = side * plane.normal;
  ground.sensor_height = side * plane.distance(sensor_in_body);
  ground.body_height = side * plane.distance(Eigen::Vector3d::Zero());
  return ground;
}
}  // namespace scanloom
