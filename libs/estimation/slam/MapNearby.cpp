#include "estimation/slam/MapNearby.h"

namespace scanloom
{
namespace
{
PointCloud meansFrom(const Rigid& map_T_body, const BinnedPoints& binned)
{
  const Rigid body_T_map = map_T_body.inverse();
  PointCloud points;
  points.resize(binned.bins.size());
  for (std::size_t i = 0; i < binned.bins.size(); ++i)
  {
    const Eigen::Vector3f mean = (body_T_map * meanOf(binned.bins[i], edgeOf(binned.cell_quanta))).cast<float>();
    points.x[i] = mean.x();
    points.y[i] = mean.y();
    points.z[i] = mean.z();
  }
  return points;
}
}  // namespace

MapNearby::MapNearby(std::shared_ptr<const PriorMap> map) : map_(std::move(map))
{
  if (map_) given_.resize(map_->keyframes().size());
}

std::optional<Keyframe> MapNearby::next(const StateEstimate& estimate)
{
  constexpr double kNear = 60;  // m
  if (!map_ || !estimate.in_map) return std::nullopt;
  if (estimate.entered_map) given_.assign(given_.size(), false);
  for (const std::size_t i : map_->around(estimate.map_T_body.translation, given_.size(), kNear))
  {
    if (given_[i]) continue;
    given_[i] = true;
    const PriorMap::Keyframe& keyframe = map_->keyframes()[i];
    return Keyframe{estimate.stamp, keyframe.map_T_body, meansFrom(keyframe.map_T_body, keyframe.points)};
  }
  return std::nullopt;
}
}  // namespace scanloom
