#include "estimation/slam/PriorMap.h"

#include "estimation/ndt/ForestCorrections.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace scanloom
{
PriorMap::PriorMap(const std::vector<scanloom::Keyframe>& keyframes, const std::vector<MountedLidar>& lidars,
                   const SlamSettings& settings, const std::vector<Matrix6d>& covariances)
  : cells_(settings.map_cells), lidars_(lidars), keyframes_(keyframes.size())
{
  if (keyframes.empty()) throw std::invalid_argument("a map without a keyframe");
  const CellCorrections corrections = cellCorrections(settings.slam.forest);
  tbb::parallel_for(std::size_t{0}, keyframes.size(),
                    [&](std::size_t i)
                    {
                      const Rigid& map_T_body = keyframes[i].map_T_body;
                      const std::vector<View> views = viewsOf(keyframes[i].points, posesOf(lidars), corrections);
                      keyframes_[i] = {map_T_body, covariances.empty() ? Matrix6d::Zero() : covariances.at(i),
                                       binned(movedBy(map_T_body, views), cells_)};
                    });
}

std::vector<std::size_t> PriorMap::around(const Eigen::Vector3d& place, std::size_t count, double radius) const
{
  std::vector<std::size_t> near;
  const auto distance = [&](std::size_t i) { return (keyframes_[i].map_T_body.translation - place).norm(); };
  for (std::size_t i = 0; i < keyframes_.size(); ++i)
    if (distance(i) <= radius) near.push_back(i);
  std::stable_sort(near.begin(), near.end(), [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
  near.resize(std::min(near.size(), count));
  std::sort(near.begin(), near.end());
  return near;
}

Matrix6d PriorMap::covarianceAt(const Rigid& map_T_body) const
{
  const std::size_t nearest = around(map_T_body.translation, 1, std::numeric_limits<double>::infinity()).front();
  const Keyframe& keyframe = keyframes_[nearest];
  return movedTo(keyframe.map_T_body.inverse() * map_T_body, keyframe.covariance);
}

NdtMap PriorMap::whole() const
{
  BinnedPoints all = keyframes_.front().points;
  for (std::size_t i = 1; i < keyframes_.size(); ++i) all.bins = sumOf(all.bins, keyframes_[i].points.bins);
  NdtMap map(cells_);
  map.add(all);
  return map;
}
}  // namespace scanloom
