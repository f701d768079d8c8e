#include "calibration/internal/CoVisiblePoints.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scanloom
{
namespace
{
constexpr double kNear = 0.3;        // m
constexpr float kRoomBehind = 0.5F;  // m: a point farther behind the farthest return in its direction is hidden

/** Mean angle in rad between the channels of a lidar, from the lowest and the highest ring with a return. */
double beamSpacing(const PointCloud& points, const Rigid& sensor_T_body)
{
  if (points.empty()) return 0;
  const auto [low, high] = std::minmax_element(points.ring.begin(), points.ring.end());
  if (*low == *high) return 0;
  const auto altitude = [&](auto ring)
  {
    const Eigen::Vector3d p =
        sensor_T_body * points.position(static_cast<std::size_t>(ring - points.ring.begin())).cast<double>();
    return std::atan2(p.z(), p.head<2>().norm());
  };
  return std::abs(altitude(high) - altitude(low)) / (*high - *low);
}

/** The farthest return of B in every direction. */
class DepthImage
{
 public:
  DepthImage(const PointCloud& points, const Rigid& body_T_sensor)
    : sensor_T_body_(body_T_sensor.inverse()),
      step_(std::max(beamSpacing(points, sensor_T_body_), 0.5 * M_PI / 180)),
      width_(static_cast<int>(2 * M_PI / step_) + 1),
      depth_(static_cast<std::size_t>(width_ * (static_cast<int>(M_PI / step_) + 1)), 0.F)
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const Eigen::Vector3d p = sensor_T_body_ * points.position(i).cast<double>();
      float& depth = depth_[pixelOf(p)];
      depth = std::max(depth, static_cast<float>(p.norm()));
    }
  }

  /** Whether B should see a point of the body frame: it is not hidden, and B's beams are at most 2 kNear apart there.
   */
  bool sees(const Eigen::Vector3d& in_body) const
  {
    const Eigen::Vector3d p = sensor_T_body_ * in_body;
    const double range = p.norm();
    return range > 0.5 && range * step_ < 2 * kNear && range < depth_[pixelOf(p)] + kRoomBehind;
  }

 private:
  std::size_t pixelOf(const Eigen::Vector3d& p) const
  {
    const int u = static_cast<int>((std::atan2(p.y(), p.x()) + M_PI) / step_);
    const int v = static_cast<int>((std::atan2(p.z(), p.head<2>().norm()) + M_PI / 2) / step_);
    return static_cast<std::size_t>(v * width_ + std::min(u, width_ - 1));
  }

  Rigid sensor_T_body_;
  double step_;  // rad
  int width_;
  std::vector<float> depth_;  // m; 0: no return
};

/** The points of a cloud, sorted to find those within kNear of a position. */
class Neighbours
{
 public:
  explicit Neighbours(const PointCloud& cloud)
  {
    for (std::size_t i = 0; i < cloud.size(); ++i) points_.push_back({cubeOf(cloud.position(i)), cloud.position(i)});
    std::sort(points_.begin(), points_.end(), [](const Placed& a, const Placed& b) { return less(a.cube, b.cube); });
  }

  bool has(const Eigen::Vector3f& p) const
  {
    const Eigen::Vector3i centre = cubeOf(p);
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        if (hasInColumn(centre + Eigen::Vector3i(dx, dy, 0), p)) return true;
    return false;
  }

 private:
  struct Placed
  {
    Eigen::Vector3i cube;
    Eigen::Vector3f position;
  };

  static Eigen::Vector3i cubeOf(const Eigen::Vector3f& p)
  {
    return (p / static_cast<float>(kNear)).array().floor().cast<int>();
  }
  static bool less(const Eigen::Vector3i& a, const Eigen::Vector3i& b)
  {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  }

  /** Searches three cubes above each other, which are also neighbours in the list. */
  bool hasInColumn(const Eigen::Vector3i& middle, const Eigen::Vector3f& p) const
  {
    const Eigen::Vector3i lowest = middle - Eigen::Vector3i::UnitZ(), highest = middle + Eigen::Vector3i::UnitZ();
    auto at = std::lower_bound(points_.begin(), points_.end(), lowest,
                               [](const Placed& a, const Eigen::Vector3i& cube) { return less(a.cube, cube); });
    for (; at != points_.end() && !less(highest, at->cube); ++at)
      if ((at->position - p).squaredNorm() < static_cast<float>(kNear * kNear)) return true;
    return false;
  }

  std::vector<Placed> points_;
};
}  // namespace

CoVisiblePoints commonView(const PointCloud& a, const Rigid& correction, const PointCloud& b, const Rigid& body_T_b)
{
  const DepthImage seen_by_b(b, body_T_b);
  const Neighbours neighbours(b);
  CoVisiblePoints view;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const Eigen::Vector3d p = correction * a.position(i).cast<double>();
    if (!seen_by_b.sees(p)) continue;
    ++view.common;
    view.near += neighbours.has(p.cast<float>()) ? 1 : 0;
  }
  return view;
}
}  // namespace scanloom
