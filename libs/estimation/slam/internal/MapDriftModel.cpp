#include "estimation/slam/internal/MapDriftModel.h"

#include "estimation/graph/PosePriorFactor.h"

#include <algorithm>

namespace scanloom
{
ErrorShares meanOf(const std::vector<WeightedError>& errors)
{
  ErrorShares mean;
  double weights = 0;
  for (const auto& [weight, error] : errors)
  {
    weights += weight;
    mean.resize(std::max(mean.size(), error.size()));
    for (std::size_t i = 0; i < error.size(); ++i) mean[i] += weight * error[i];
  }
  for (double& share : mean) share /= weights;
  return mean;
}

ErrorShares difference(ErrorShares later, const ErrorShares& earlier)
{
  for (std::size_t i = 0; i < earlier.size(); ++i) later[i] -= earlier[i];
  return later;
}

ErrorShares MapDriftModel::add(ErrorShares map, const Rigid& map_T_body, const Matrix6d& alignment)
{
  map.resize(alignments_.size());
  map.push_back(1);
  alignments_.push_back(movedTo(map_T_body.inverse(), alignment));
  return map;
}

Matrix6d MapDriftModel::covariance(const ErrorShares& shares) const
{
  Matrix6d sum = Matrix6d::Zero();
  for (std::size_t i = 0; i < shares.size(); ++i) sum += shares[i] * shares[i] * alignments_[i];
  return sum;
}
}  // namespace scanloom
