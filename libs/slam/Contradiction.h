#pragma once
#include "core/Time.h"

#include <deque>
#include <utility>

namespace scanloom
{
/**
 * Whether lidar and IMU contradict each other for good. A scan that is far from its prediction says little; where half
 * of those of ten seconds are, the map or its place in it is wrong, though every scan finds its match.
 */
class Contradiction
{
 public:
  /** Of every registration: the deviations between it and its prediction (StateEstimate::surprise). */
  void add(Timestamp, double surprise);

  /** The median of the last ten seconds; 0 until they are over, or if they hold fewer than five registrations. */
  double median() const { return median_; }

  void clear() { *this = {}; }

 private:
  std::deque<std::pair<Timestamp, double>> last_;
  double median_ = 0;
};
}  // namespace scanloom
