/** How many registrations count as one measurement, because their errors repeat. */
#pragma once
#include "base/core/Time.h"

#include <Eigen/Core>

#include <optional>

namespace scanloom
{
/**
 * Leaves seen from one side, occlusions and the map's cells displace a registration in the same way as the one before,
 * until the machine has moved on. As independent measurements they would outvote the IMU by their number.
 */
class MeasurementCorrelation
{
 public:
  /** Where a registration has placed the body, m, in the local map. Stamps ascend. */
  void add(Timestamp, const Eigen::Vector3d& position);

  /** m, between the last two registrations; 0 until there are two. */
  double travel() const;

  /** Registrations per measurement, at least 1, of an error that stays the same over `length` m of travel. */
  double registrationsPerTravel(double length) const;

  /**
   * The same, but while the machine stands, registrations of one second count as one: a constant error does not look
   * like a motion. With fewer measurements the estimate moves by centimetres, because the IMU integrates gravity along
   * any error of the tilt.
   */
  double registrationsPerTravelOrRest(double length) const;

 private:
  struct Placed
  {
    Timestamp stamp;
    Eigen::Vector3d position;
  };

  /** Whether registrations have been in one place for a second: the IMU's velocity is not certain enough to tell. */
  bool stands() const;

  std::optional<Placed> last_;
  std::optional<Placed> before_last_;
  std::optional<Placed> in_place_since_;  // the first of those at one place
};
}  // namespace scanloom
