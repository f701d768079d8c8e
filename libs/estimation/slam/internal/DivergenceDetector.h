#pragma once
#include "base/core/Rigid.h"

namespace scanloom
{
enum class Divergence
{
  None,        // the last registration agrees with the estimate
  Suspected,   // the last registration was off
  Apparent,    // the last one was far off, or the last four were off: the pose is not to be relied on
  Persistent,  // three far off in a row, or six that were off: the IMU is the wrong one
};

/**
 * Tells whether estimates lie apart from what the lidar sees. A single registration may be wrong, and the IMU knows
 * better; of three that are far off in a row, or of six that are off, the IMU is the wrong one.
 */
class DivergenceDetector
{
 public:
  /** For every trusted registration: boxMinus(estimate, registration), and the covariance of both together. */
  void add(const Vector6d& apart, const Matrix6d& covariance);

  Divergence level() const;

 private:
  int evidence_ = 0;  // registrations in a row that are off; far off ones count twice
  bool far_ = false;
};
}  // namespace scanloom
