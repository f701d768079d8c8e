#include "estimation/ndt/View.h"

#include "base/core/Statistics.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace scanloom
{
namespace
{
/** The mean sine of the elevation of what each ring saw. */
class RingElevations
{
 public:
  void add(std::uint8_t ring, double sine)
  {
    sums_[ring] += sine;
    ++counts_[ring];
  }

  /** rad, the median of the angles from a ring to the next; none if there is but one ring. */
  std::optional<double> spacing() const
  {
    std::vector<double> elevations;
    for (std::size_t ring = 0; ring < counts_.size(); ++ring)
      if (counts_[ring] != 0) elevations.push_back(std::asin(std::clamp(sums_[ring] / counts_[ring], -1.0, 1.0)));
    if (elevations.size() < 2) return std::nullopt;
    std::sort(elevations.begin(), elevations.end());
    std::vector<double> steps;
    for (std::size_t i = 1; i < elevations.size(); ++i) steps.push_back(elevations[i] - elevations[i - 1]);
    return upperMedian(std::move(steps));
  }

 private:
  std::array<double, 256> sums_{};
  std::array<int, 256> counts_{};
};

/** `rings`: of the view's points. Some eight stretches of the turn, of whole columns, suffice. */
std::optional<Rings> ringsOf(const View& view, const std::vector<std::uint8_t>& rings, const Rigid& cloud_T_lidar)
{
  const std::size_t stretch = 512, stretches = 8;
  const Eigen::Vector3d axis = cloud_T_lidar.rotation * Eigen::Vector3d::UnitZ();
  const std::size_t step = std::max<std::size_t>(1, rings.size() / (stretch * stretches)) * stretch;
  RingElevations elevations;
  for (std::size_t first = 0; first < rings.size(); first += step)
    for (std::size_t i = first; i < std::min(first + stretch, rings.size()); ++i)
    {
      const Eigen::Vector3d sight = view.points[i].cast<double>() - cloud_T_lidar.translation;
      const double range = sight.norm();
      if (range > 0) elevations.add(rings[i], axis.dot(sight) / range);
    }
  const std::optional<double> spacing = elevations.spacing();
  return spacing ? std::optional<Rings>({axis, *spacing}) : std::nullopt;
}
}  // namespace

std::vector<View> viewsOf(const PointCloud& cloud, const std::vector<Rigid>& cloud_T_lidar,
                          const CellCorrections& corrections)
{
  const std::size_t lidars = cloud_T_lidar.size();
  std::vector<View> views(lidars + 1);
  tbb::parallel_for(std::size_t{0}, views.size(),
                    [&](std::size_t v)
                    {
                      std::vector<Eigen::Vector3f>& points = views[v].points;
                      std::vector<std::uint8_t> rings;
                      points.reserve(cloud.size() / std::max<std::size_t>(1, lidars));
                      rings.reserve(points.capacity());
                      for (std::size_t i = 0; i < cloud.size(); ++i)
                      {
                        if (std::min<std::size_t>(cloud.sensor_id[i], lidars) != v) continue;
                        points.push_back(cloud.position(i));
                        rings.push_back(cloud.ring[i]);
                      }
                      if (v == lidars) return;
                      views[v].corrections = corrections;
                      views[v].viewpoint = cloud_T_lidar[v].translation;
                      views[v].rings = ringsOf(views[v], rings, cloud_T_lidar[v]);
                    });
  return views;
}

View movedBy(const Rigid& target_T_view, const View& view)
{
  // Points are turned in double: far from the origin a rotation in float would cost millimetres.
  const Eigen::Matrix3d rotation = target_T_view.rotation.toRotationMatrix();
  View moved;
  moved.corrections = view.corrections;
  moved.points.reserve(view.points.size());
  for (const Eigen::Vector3f& p : view.points)
    moved.points.emplace_back((rotation * p.cast<double>() + target_T_view.translation).cast<float>());
  if (view.viewpoint) moved.viewpoint = target_T_view * *view.viewpoint;
  if (view.rings) moved.rings = Rings{rotation * view.rings->axis, view.rings->spacing};
  return moved;
}

std::vector<View> movedBy(const Rigid& target_T_views, const std::vector<View>& views)
{
  std::vector<View> moved;
  for (const View& view : views) moved.push_back(movedBy(target_T_views, view));
  return moved;
}
}  // namespace scanloom
