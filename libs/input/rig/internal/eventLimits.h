/** The queue between the thread that batches and the one that takes events. */
#pragma once
#include "base/core/BoundedQueue.h"
#include "input/rig/Rig.h"
#include "input/rig/SensorInput.h"

#include <vector>

namespace scanloom
{
template <typename Event>
std::size_t kindOf()
{
  return SensorEvent(Event{}).index();
}

/** By kind: how many events wait for whoever calls next(). */
std::vector<std::size_t> eventLimits(const Rig&);

/** What waits in such a queue, and what it dropped. */
template <typename Event>
void addQueueCounts(const BoundedQueue<Event>& queue, RigAccount& account)
{
  account.input["scans_dropped"] = queue.dropped(kindOf<Scan>());
  account.input["slices_dropped"] = queue.dropped(kindOf<ScanPart>());
  account.input["imu_samples_dropped"] += queue.dropped(kindOf<SensorImu>());
  account.scans_waiting = queue.waiting(kindOf<Scan>());
}
}  // namespace scanloom
