#include "estimation/slam/internal/MeasurementCorrelation.h"

#include "estimation/ndt/FittedConstants.h"

#include <algorithm>

namespace scanloom
{
void MeasurementCorrelation::add(Timestamp stamp, const Eigen::Vector3d& position)
{
  before_last_ = last_;
  last_ = {stamp, position};
  if (!in_place_since_ || (in_place_since_->position - position).norm() > fitted::kPlaceRadius) in_place_since_ = last_;
}

double MeasurementCorrelation::travel() const
{
  return before_last_ ? (before_last_->position - last_->position).norm() : 0;
}

double MeasurementCorrelation::registrationsPerTravel(double length) const
{
  // At rest many scans count as one, but not as none.
  return std::max(1.0, length / std::max(travel(), fitted::kLeastTravel));
}

double MeasurementCorrelation::registrationsPerTravelOrRest(double length) const
{
  return stands() ? std::max(1.0, 1 / seconds(last_->stamp - before_last_->stamp)) : registrationsPerTravel(length);
}

bool MeasurementCorrelation::stands() const { return last_ && last_->stamp - in_place_since_->stamp >= 1s; }
}  // namespace scanloom
