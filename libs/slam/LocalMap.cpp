#include "slam/LocalMap.h"

#include "core/Matrix6.h"
#include "graph/PosePriorFactor.h"

#include <algorithm>

namespace scanloom
{
namespace
{
// Both by the NEES of simulated drives of 75 to 140 m (doc/study/localisation.md): an alignment averages over the
// keyframes of the map, whose errors are partly its own again; and structure that is seen from one side shortens a way.
constexpr double kHandedOn = 0.3;  // of an alignment's covariance
constexpr double kScale = 6e-4;    // standard deviation of the way, as a share of the distance
}  // namespace

LocalMap::LocalMap(const LocalMapOptions& options, const NdtOptions& ndt) : options_(options), ndt_(ndt) {}

bool LocalMap::wants(const Rigid& map_T_body) const
{
  if (empty()) return true;
  const Vector6d travel = boxMinus(map_T_body, keyframes_.back().map_T_body);
  return travel.head<3>().norm() >= options_.keyframe_distance ||
         travel.tail<3>().norm() >= options_.keyframe_turn_deg * M_PI / 180;
}

const Eigen::Vector3d& LocalMap::oldest() const
{
  return std::find_if(keyframes_.begin(), keyframes_.end(), [](const Keyframe& k) { return k.in_map; })
      ->map_T_body.translation;
}

void LocalMap::clear()
{
  keyframes_.clear();
  ndt_ = NdtMap(ndt_.options());
}

Matrix6d LocalMap::handedOn(const Rigid& map_T_body) const
{
  if (empty()) return Matrix6d::Zero();
  const Keyframe& newest = keyframes_.back();
  return congruent(newest.drift, bodyStepByImuStep(newest.map_T_body.inverse() * map_T_body).transpose());
}

Matrix6d LocalMap::drift(const Rigid& map_T_body) const
{
  Matrix6d drift = handedOn(map_T_body);
  const Eigen::Vector3d way = map_T_body.rotation.conjugate() * (map_T_body.translation - begin_);
  drift.topLeftCorner<3, 3>() += kScale * kScale * way * way.transpose();
  return drift;
}

void LocalMap::add(const std::vector<View>& seen_from_body, const Rigid& map_T_body, const Matrix6d& alignment)
{
  if (empty()) begin_ = map_T_body.translation;
  const Matrix6d drift = empty() ? Matrix6d::Zero() : Matrix6d(handedOn(map_T_body) + kHandedOn * alignment);
  std::vector<View> in_map;
  for (const View& view : seen_from_body) in_map.push_back(movedBy(map_T_body, view));
  keyframes_.push_back({map_T_body, binned(in_map, ndt_.options()), drift});
  for (std::size_t i = 0; i < keyframes_.size(); ++i)
  {
    Keyframe& keyframe = keyframes_[i];
    const bool belongs = this->belongs(keyframe, keyframes_.size() - 1 - i);
    if (belongs && !keyframe.in_map) ndt_.add(keyframe.points);
    if (!belongs && keyframe.in_map) ndt_.remove(keyframe.points);
    keyframe.in_map = belongs;
  }
  if (options_.radius == 0 && !keyframes_.front().in_map) keyframes_.pop_front();
}

/** `age`: number of newer keyframes. */
bool LocalMap::belongs(const Keyframe& keyframe, std::size_t age) const
{
  if (options_.radius == 0) return age < static_cast<std::size_t>(options_.keyframes);
  return (keyframe.map_T_body.translation - keyframes_.back().map_T_body.translation).norm() <= options_.radius;
}
}  // namespace scanloom
