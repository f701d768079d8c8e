#include "estimation/slam/internal/LocalMap.h"

#include <algorithm>
#include <utility>

namespace scanloom
{
namespace
{
constexpr double kKeyframeTurnDeg = 20.0;  // deg: turn since the last keyframe at which a new one is added

/** Cells that both have. */
int commonCells(const BinnedPoints& a, const BinnedPoints& b)
{
  int common = 0;
  auto in_b = b.bins.cbegin();
  for (const Bin& bin : a.bins)
  {
    while (in_b != b.bins.cend() && in_b->key < bin.key) ++in_b;
    if (in_b != b.bins.cend() && in_b->key == bin.key) ++common;
  }
  return common;
}
}  // namespace

LocalMap::LocalMap(const LocalMapOptions& options, const NdtOptions& ndt) : options_(options), ndt_(ndt) {}

bool LocalMap::wants(const Rigid& map_T_body) const
{
  if (empty()) return true;
  const Vector6d travel = boxMinus(map_T_body, keyframes_.back().map_T_body);
  return travel.head<3>().norm() >= options_.keyframe_distance ||
         travel.tail<3>().norm() >= kKeyframeTurnDeg * M_PI / 180;
}

const Eigen::Vector3d& LocalMap::oldest() const
{
  return std::find_if(keyframes_.begin(), keyframes_.end(), [](const Keyframe& k) { return k.in_map; })
      ->map_T_body.translation;
}

void LocalMap::clear()
{
  keyframes_.clear();
  errors_ = {};
  map_error_.clear();
  ndt_ = NdtMap(ndt_.options());
}

/** Error of what the newest keyframe sees: keyframes count by the cells that they have in common with it, and by one
 * more, so that there is a mean where it sees none of them. */
ErrorShares LocalMap::errorOfMap() const
{
  std::vector<WeightedError> errors;
  for (const Keyframe& keyframe : keyframes_)
    if (keyframe.in_map)
      errors.push_back({1.0 + commonCells(keyframe.points, keyframes_.back().points), keyframe.error});
  return meanOf(errors);
}

Matrix6d LocalMap::add(const std::vector<View>& seen_from_body, const Rigid& map_T_body, const Matrix6d& alignment)
{
  std::vector<View> in_map;
  for (const View& view : seen_from_body) in_map.push_back(movedBy(map_T_body, view));
  keyframes_.push_back({map_T_body, binned(in_map, ndt_.options()), {}});
  if (keyframes_.size() > 1) keyframes_.back().error = errors_.add(errorOfMap(), map_T_body, alignment);
  for (std::size_t i = 0; i < keyframes_.size(); ++i)
  {
    Keyframe& keyframe = keyframes_[i];
    const bool belongs = this->belongs(keyframe, keyframes_.size() - 1 - i);
    if (belongs && !keyframe.in_map) ndt_.add(keyframe.points);
    if (!belongs && keyframe.in_map) ndt_.remove(keyframe.points);
    keyframe.in_map = belongs;
  }
  if (options_.radius == 0 && !keyframes_.front().in_map) keyframes_.pop_front();
  const ErrorShares before = std::exchange(map_error_, errorOfMap());
  return errors_.covariance(difference(map_error_, before));
}

/** `age`: number of newer keyframes. */
bool LocalMap::belongs(const Keyframe& keyframe, std::size_t age) const
{
  if (options_.radius == 0) return age < static_cast<std::size_t>(options_.keyframes);
  return (keyframe.map_T_body.translation - keyframes_.back().map_T_body.translation).norm() <= options_.radius;
}
}  // namespace scanloom
