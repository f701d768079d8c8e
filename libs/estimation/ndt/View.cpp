#include "estimation/ndt/View.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace scanloom
{
std::vector<View> viewsOf(const PointCloud& cloud, const std::vector<Eigen::Vector3d>& viewpoints)
{
  std::vector<View> views(viewpoints.size() + 1);
  for (std::size_t i = 0; i < viewpoints.size(); ++i) views[i].viewpoint = viewpoints[i];
  tbb::parallel_for(std::size_t{0}, views.size(),
                    [&](std::size_t v)
                    {
                      std::vector<Eigen::Vector3f>& points = views[v].points;
                      points.reserve(cloud.size() / std::max<std::size_t>(1, viewpoints.size()));
                      for (std::size_t i = 0; i < cloud.size(); ++i)
                        if (std::min<std::size_t>(cloud.sensor_id[i], viewpoints.size()) == v)
                          points.push_back(cloud.position(i));
                    });
  return views;
}

View movedBy(const Rigid& target_T_view, const View& view)
{
  // In double up to the target's frame: far from the origin a float rotation alone would cost millimetres.
  const Eigen::Matrix3d rotation = target_T_view.rotation.toRotationMatrix();
  View moved;
  moved.points.reserve(view.points.size());
  for (const Eigen::Vector3f& p : view.points)
    moved.points.emplace_back((rotation * p.cast<double>() + target_T_view.translation).cast<float>());
  if (view.viewpoint) moved.viewpoint = target_T_view * *view.viewpoint;
  return moved;
}
}  // namespace scanloom
