#pragma once
#include "base/core/ImuSample.h"
#include "estimation/slam/StateEstimate.h"

#include <deque>
#include <optional>

namespace scanloom
{
/** A body between estimates, which come late and once a scan, by the readings of its IMU since the newest of them. */
class PredictedMotion
{
 public:
  struct Motion
  {
    Timestamp stamp;
    Rigid map_T_body;
    Eigen::Vector3d velocity;   // m/s, of the body's origin, along the body's axes
    Eigen::Vector3d turn_rate;  // rad/s, about the body's axes
  };

  /** From here on samples are of the IMU at this pose. */
  void setImu(const Rigid& body_T_imu) { body_T_imu_ = body_T_imu; }

  /** As the newest sample says; none before the first estimate, or if the newest is a second old. */
  std::optional<Motion> add(const ImuSample&);

  /** The motion at the estimate's time. */
  Motion correct(const StateEstimate&);

 private:
  Motion motion() const;
  void advance(const ImuSample& from, const ImuSample& to);

  Rigid body_T_imu_;
  std::deque<ImuSample> samples_;       // of the last second
  std::optional<NavState> state_;       // of the IMU, at the newest sample that moved it, or the estimate
  Timestamp corrected_;                 // the newest estimate
  Eigen::Vector3d turn_rate_{0, 0, 0};  // rad/s, of the IMU, without its bias
};
}  // namespace scanloom
