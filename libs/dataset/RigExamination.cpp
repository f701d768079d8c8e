#include "dataset/RigExamination.h"

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr Duration kLately = 2s;  // long enough for a fast packet, short enough for no drift to matter

Duration leastDelayLately(const std::vector<Arrival>& arrivals)
{
  Duration least = arrivals.back().delay();
  for (const Arrival& arrival : arrivals)
    if (arrival.received >= arrivals.back().received - kLately) least = std::min(least, arrival.delay());
  return least;
}

LidarExamination examineLidar(const LidarEvidence& evidence, Duration deadline, const ClockLimits& limits)
{
  const Duration least_step = fromSeconds(1e-3 * limits.step_ms);
  const std::vector<PacketRun> runs = packetRuns(evidence.packets, evidence.lidar);
  const std::vector<Arrival> arrivals = arrivalsOn(runs, evidence.lidar, least_step);

  LidarExamination seen;
  seen.name = evidence.name;
  seen.lidar = evidence.lidar;
  seen.delivery = deliveryOf(runs, evidence.lidar);
  seen.malformed = evidence.malformed;
  seen.bad_crc = evidence.bad_crc;
  seen.flags = sensorFlags(evidence.packets);
  seen.steps = clockSteps(runs, evidence.lidar, least_step);
  seen.drift = clockDrift(arrivals, fromSeconds(limits.drift_time));
  seen.jitter = arrivalJitter(arrivals, seen.drift);
  seen.late_share = shareBeyond(arrivals, seen.drift, deadline);
  seen.phase = rotorPhase(runs, evidence.lidar, least_step);
  if (arrivals.empty()) return seen;
  seen.epoch = epochOf(arrivals.back().stamp, arrivals.back().received);
  seen.ahead_of_host = -leastDelayLately(arrivals);
  return seen;
}
}  // namespace

RigExamination examine(const RigEvidence& evidence, const DoctorLimits& limits)
{
  RigExamination rig;
  rig.strangers = evidence.strangers;
  rig.deadline = evidence.deadline;
  for (const LidarEvidence& lidar : evidence.lidars)
    rig.lidars.push_back(examineLidar(lidar, evidence.deadline, limits.clocks));

  for (std::size_t i = 1; i < rig.lidars.size(); ++i)
  {
    const LidarExamination& first = rig.lidars.front();
    LidarExamination& other = rig.lidars[i];
    if (first.ahead_of_host && other.ahead_of_host) other.ahead_of_first = *other.ahead_of_host - *first.ahead_of_host;
    if (first.drift && other.drift) other.drift_to_first = *other.drift - *first.drift;
  }
  return rig;
}
}  // namespace scanloom
