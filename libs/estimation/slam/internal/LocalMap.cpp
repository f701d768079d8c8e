#include "estimation/slam/internal/LocalMap.h"

#include "estimation/ndt/FittedConstants.h"
#include "estimation/slam/PriorMap.h"

#include <algorithm>
#include <utility>

namespace scanloom
{
namespace
{
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

LocalMap::LocalMap(const LocalMapOptions& options, const NdtOptions& ndt, std::shared_ptr<const PriorMap> prior)
  : options_(options), ndt_(ndt), prior_(std::move(prior))
{
}

bool LocalMap::wants(const Rigid& map_T_body) const
{
  if (empty()) return true;
  const auto isNear = [&](const auto& keyframe)
  { return (keyframe.map_T_body.translation - map_T_body.translation).norm() < options_.keyframe_distance; };
  if (prior_)
    return std::none_of(keyframes_.begin(), keyframes_.end(), isNear) &&
           std::none_of(prior_->keyframes().begin(), prior_->keyframes().end(), isNear);
  const Vector6d travel = boxMinus(map_T_body, keyframes_.back().map_T_body);
  return travel.head<3>().norm() >= options_.keyframe_distance ||
         travel.tail<3>().norm() >= fitted::kKeyframeTurnDeg * M_PI / 180;
}

/** Sums of points are integers: what is removed leaves no trace. */
void LocalMap::moveTo(const Eigen::Vector3d& place)
{
  if (!prior_ || (moved_to_ && (place - *moved_to_).norm() < fitted::kWayInMap)) return;
  moved_to_ = place;
  const std::vector<std::size_t> near =
      prior_->around(place, static_cast<std::size_t>(options_.keyframes), fitted::kSightInMap);
  const std::vector<std::size_t> before = std::exchange(of_prior_, near);
  for (const std::size_t i : before)
    if (!std::binary_search(near.begin(), near.end(), i)) ndt_.remove(prior_->keyframes()[i].points);
  for (const std::size_t i : near)
    if (!std::binary_search(before.begin(), before.end(), i)) ndt_.add(prior_->keyframes()[i].points);
}

Matrix6d LocalMap::covarianceOfPrior(const Rigid& map_T_body) const { return prior_->covarianceAt(map_T_body); }

const Eigen::Vector3d& LocalMap::oldest() const
{
  if (!of_prior_.empty()) return prior_->keyframes()[of_prior_.front()].map_T_body.translation;
  return std::find_if(keyframes_.begin(), keyframes_.end(), [](const Keyframe& k) { return k.in_map; })
      ->map_T_body.translation;
}

void LocalMap::clear()
{
  keyframes_.clear();
  errors_ = {};
  map_error_.clear();
  ndt_ = NdtMap(ndt_.options());
  prior_.reset();
  of_prior_.clear();
  moved_to_.reset();
}

/** Error of what the newest keyframe sees: keyframes count by the cells that they have in common with it, and by one
 * more, so that there is a mean where it sees none of them. Those of an earlier drive are the map: they have none. */
ErrorShares LocalMap::errorOfMap() const
{
  const ErrorShares none;
  std::vector<WeightedError> errors;
  for (const std::size_t i : of_prior_)
    errors.push_back({1.0 + commonCells(prior_->keyframes()[i].points, keyframes_.back().points), none});
  for (const Keyframe& keyframe : keyframes_)
    if (keyframe.in_map)
      errors.push_back({1.0 + commonCells(keyframe.points, keyframes_.back().points), keyframe.error});
  return meanOf(errors);
}

Matrix6d LocalMap::add(const std::vector<View>& seen_from_body, const Rigid& map_T_body, const Matrix6d& alignment)
{
  keyframes_.push_back({map_T_body, binned(movedBy(map_T_body, seen_from_body), ndt_.options()), {}});
  if (keyframes_.size() > 1 || !of_prior_.empty())
    keyframes_.back().error = errors_.add(errorOfMap(), map_T_body, alignment);
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
