#pragma once
#include "core/Rigid.h"

namespace scanloom
{
/**
 * Tells whether estimates lie apart from what the lidar sees. A single registration may be wrong, and the IMU knows
 * better; of three that are far off in a row, or of six that are off, the IMU is the wrong one.
 */
class Separation
{
 public:
  /** For every trusted registration: boxMinus(estimate, registration), and the covariance of both together. */
  void add(const Vector6d& apart, const Matrix6d& covariance);

  /** The last registration was off. */
  bool suspected() const { return evidence_ > 0; }

  /** The last registration was far off, or the last four were off: the pose is not to be relied on. */
  bool exists() const { return far_ || evidence_ >= 4; }

  /** The lidar is to be believed. */
  bool lasts() const { return evidence_ >= 6; }

 private:
  int evidence_ = 0;  // registrations in a row that are off; far off ones count twice
  bool far_ = false;
};
}  // namespace scanloom
