#include "slam/LocalMap.h"

namespace scanloom
{
namespace
{
std::vector<Eigen::Vector3f> movedBy(const Rigid& map_T_body, const PointCloud& points)
{
  // In double up to the map frame: far from the origin a float rotation alone would cost millimetres.
  const Eigen::Matrix3d rotation = map_T_body.rotation.toRotationMatrix();
  std::vector<Eigen::Vector3f> moved;
  moved.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    moved.emplace_back((rotation * points.position(i).cast<double>() + map_T_body.translation).cast<float>());
  return moved;
}
}  // namespace

LocalMap::LocalMap(const LocalMapOptions& options, const NdtOptions& ndt) : options_(options), ndt_(ndt) {}

bool LocalMap::wants(const Rigid& map_T_body) const
{
  if (empty()) return true;
  const Vector6d travel = boxMinus(map_T_body, keyframes_.back().map_T_body);
  return travel.head<3>().norm() >= options_.keyframe_distance ||
         travel.tail<3>().norm() >= options_.keyframe_turn_deg * M_PI / 180;
}

void LocalMap::clear()
{
  keyframes_.clear();
  ndt_ = NdtMap(ndt_.options());
}

void LocalMap::add(const PointCloud& points_in_body, const Rigid& map_T_body)
{
  keyframes_.push_back({map_T_body, NdtMap(movedBy(map_T_body, points_in_body), ndt_.options())});
  ndt_.add(keyframes_.back().ndt);
  if (keyframes_.size() <= static_cast<std::size_t>(options_.keyframes)) return;
  ndt_.remove(keyframes_.front().ndt);
  keyframes_.pop_front();
}
}  // namespace scanloom
