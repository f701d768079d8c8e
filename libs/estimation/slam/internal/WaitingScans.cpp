#include "estimation/slam/internal/WaitingScans.h"

#include <utility>

namespace scanloom
{
bool WaitingScans::wants(const Scan& scan)
{
  const bool in_turn = !isCutStart(scan) && seen_++ % every_nth_ == 0;
  // A whole turn that found no other in time may end before those that did: time never goes back.
  const bool late = last_end_ && scan.end() <= *last_end_;
  const bool wanted = in_turn && !late;
  skipped_ += !wanted;
  return wanted;
}

void WaitingScans::add(Scan scan)
{
  last_end_ = scan.end();
  scans_.push_back(std::move(scan));
}

/** The first scans may hold a part of each lidar's turn only: a map of such a scan shares little with the next scans.
 */
bool WaitingScans::isCutStart(const Scan& scan)
{
  if (last_end_ || scan.complete()) return false;
  if (!first_start_) first_start_ = scan.start;
  return scan.start - *first_start_ < 1s;  // then a lidar may be silent for good
}

bool WaitingScans::isReady(const ImuBuffer& imu) const
{
  if (scans_.empty()) return false;
  const Scan& oldest = scans_.front();
  return input_ended_ || imu.covers(oldest.start, oldest.end()) || scans_.back().end() >= oldest.end() + imu_wait_;
}

Scan WaitingScans::take()
{
  Scan oldest = std::move(scans_.front());
  scans_.pop_front();
  return oldest;
}
}  // namespace scanloom
