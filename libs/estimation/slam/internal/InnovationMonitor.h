#pragma once
#include "base/core/Time.h"

#include <deque>
#include <utility>

namespace scanloom
{
/**
 * Tells whether lidar and IMU contradict each other for longer than a moment. A single scan that is far from its
 * prediction means little. If half of the scans of ten seconds are, the map or the body's place in it is wrong, even
 * though every scan is registered without an error.
 */
class InnovationMonitor
{
 public:
  /** For every registration: its distance from the prediction in standard deviations (StateEstimate::mahalanobis). */
  void add(Timestamp, double mahalanobis);

  /** The median of the last ten seconds; 0 until they have passed, and if they hold fewer than five registrations. */
  double median() const;

  void clear() { last_.clear(); }

 private:
  std::deque<std::pair<Timestamp, double>> last_;
};
}  // namespace scanloom
