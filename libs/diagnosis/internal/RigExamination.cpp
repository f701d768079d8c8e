#include "diagnosis/internal/RigExamination.h"

#include "base/core/Statistics.h"
#include "diagnosis/internal/FindingLimits.h"

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr Duration kLately = 2s;  // long enough to hold a fast packet, too short for drift to matter

Duration leastDelayLately(const std::vector<Arrival>& arrivals)
{
  Duration least = arrivals.back().delay();
  for (const Arrival& arrival : arrivals)
    if (arrival.received >= arrivals.back().received - kLately) least = std::min(least, arrival.delay());
  return least;
}

LidarExamination nameOnly(const LidarEvidence& evidence)
{
  LidarExamination seen;
  seen.name = evidence.name;
  seen.lidar = evidence.lidar;
  return seen;
}

LidarExamination examineLidar(const LidarEvidence& evidence, Duration deadline)
{
  const Duration least_step = fromSeconds(1e-3 * limits::kStepMs);
  const std::vector<PacketRun> runs = packetRuns(evidence.packets, evidence.lidar);
  const std::vector<Arrival> arrivals = arrivalsOn(runs, evidence.lidar, least_step);

  LidarExamination seen = nameOnly(evidence);
  seen.delivery = deliveryOf(runs, evidence.lidar);
  seen.malformed = evidence.malformed;
  seen.bad_crc = evidence.bad_crc;
  seen.flags = sensorFlags(evidence.packets);
  seen.clock.steps = clockSteps(runs, evidence.lidar, least_step);
  seen.clock.drift = clockDrift(arrivals, fromSeconds(limits::kDriftTime));
  seen.clock.phase = rotorPhase(runs, evidence.lidar, least_step);
  // Packets that are whole turns, clouds of a driver, are waited for a turn longer.
  const bool sends_turns = seen.lidar.columns_per_packet == seen.lidar.columns_per_frame;
  const Duration patience = deadline + (sends_turns ? fromSeconds(1 / seen.lidar.frame_rate) : Duration{0});
  seen.jitter = arrivalJitter(arrivals, seen.clock.drift, patience);
  if (arrivals.empty()) return seen;
  seen.clock.epoch = epochOf(arrivals.back().stamp, arrivals.back().received);
  seen.clock.ahead_of_host = -leastDelayLately(arrivals);
  return seen;
}

/** From the first stamp of any lidar to the last. */
struct TimeSpan
{
  Timestamp first = Timestamp::max(), last = Timestamp::min();
};

TimeSpan spanOf(const std::vector<LidarEvidence>& lidars)
{
  TimeSpan span;
  for (const LidarEvidence& lidar : lidars)
    for (const PacketTrace& packet : lidar.packets)
    {
      if (!packet.stamp) continue;
      span.first = std::min(span.first, *packet.stamp);
      span.last = std::max(span.last, *packet.stamp);
    }
  return span;
}

/** Samples in the order of their stamps, but for the timing. */
ImuExamination examineImu(const ImuEvidence& imu, const ImuTiming& timing, const TimeSpan& lidars)
{
  ImuExamination seen;
  seen.name = imu.name;
  seen.timing = timing;
  seen.sound = soundnessOf(imu.samples, imu.body_T_imu);
  seen.configured_pose = imu.configured_pose;
  if (lidars.first < lidars.last)
    seen.lidar_share =
        std::max(0.0, seconds(std::min(lidars.last, seen.timing.last) - std::max(lidars.first, seen.timing.first)) /
                          seconds(lidars.last - lidars.first));
  return seen;
}

std::optional<ReturnStatistics> returnStatistics(const std::vector<RigSnapshot>& snapshots, std::size_t lidar)
{
  std::uint64_t readings = 0, returns = 0;
  std::vector<double> ranges;
  for (const RigSnapshot& snapshot : snapshots)
  {
    readings += snapshot[lidar].readings;
    returns += snapshot[lidar].returns;
    for (const std::uint32_t millimetres : snapshot[lidar].points.range) ranges.push_back(1e-3 * millimetres);
  }
  if (readings == 0) return std::nullopt;
  ReturnStatistics statistics;
  statistics.share = static_cast<double>(returns) / static_cast<double>(readings);
  if (ranges.empty()) return statistics;
  std::sort(ranges.begin(), ranges.end());
  statistics.range_p05 = quantileOfSorted(ranges, 0.05);
  statistics.range_p50 = quantileOfSorted(ranges, 0.50);
  statistics.range_p95 = quantileOfSorted(ranges, 0.95);
  return statistics;
}

std::vector<const PointCloud*> turnsOf(const std::vector<RigSnapshot>& snapshots, std::size_t lidar)
{
  std::vector<const PointCloud*> turns;
  for (const RigSnapshot& snapshot : snapshots) turns.push_back(&snapshot[lidar].points);
  return turns;
}

std::vector<MountedLidar> mounted(const std::vector<LidarEvidence>& lidars)
{
  std::vector<MountedLidar> placed;
  for (const LidarEvidence& lidar : lidars) placed.push_back({lidar.name, lidar.lidar.body_T_sensor});
  return placed;
}

/** What all lidars see of the machine: shares are weighted by each lidar's number of points. */
SelfReturns machineSeenBy(const std::vector<LidarExamination>& lidars, const std::vector<RigSnapshot>& snapshots)
{
  std::vector<SelfReturns> parts;
  std::vector<std::size_t> points(lidars.size(), 0);
  for (std::size_t i = 0; i < lidars.size(); ++i)
  {
    parts.push_back(lidars[i].own_parts);
    for (const RigSnapshot& snapshot : snapshots) points[i] += snapshot[i].points.size();
  }
  return together(parts, points);
}

std::vector<BodyImu> bodyImus(const std::vector<ImuEvidence>& imus)
{
  std::vector<BodyImu> placed;
  for (const ImuEvidence& imu : imus) placed.push_back({imu.name, imu.samples, imu.body_T_imu});
  return placed;
}

PairExamination examinePair(const RigEvidence& evidence, std::size_t lidar, std::size_t reference)
{
  std::vector<SeenByBoth> pairs;
  for (const RigSnapshot& snapshot : evidence.snapshots) pairs.push_back({&snapshot[lidar], &snapshot[reference]});
  return {lidar, reference,
          cloudAgreement(pairs, evidence.lidars[lidar].lidar.body_T_sensor,
                         evidence.lidars[reference].lidar.body_T_sensor)};
}
}  // namespace

RigExamination examine(RigEvidence evidence, const CropOptions& crop_options)
{
  const Crop crop = cropOf(crop_options, mounted(evidence.lidars));
  RigExamination rig;
  static_cast<RigFacts&>(rig) = evidence;
  for (const LidarEvidence& lidar : evidence.lidars)
    rig.lidars.push_back(evidence.packets_known ? examineLidar(lidar, evidence.deadline) : nameOnly(lidar));
  for (std::size_t i = 0; i < rig.lidars.size(); ++i)
  {
    rig.lidars[i].returns = returnStatistics(evidence.snapshots, i);
    const std::vector<const PointCloud*> turns = turnsOf(evidence.snapshots, i);
    rig.lidars[i].ground = groundPlane(turns, rig.lidars[i].lidar.body_T_sensor.translation);
    SelfReturns& own = rig.lidars[i].own_parts = selfReturns(turns, rig.lidars[i].ground, crop);
    for (std::size_t k = 0; k < own.marks.size(); ++k) evidence.snapshots[k][i].own = std::move(own.marks[k]);
    own.marks.clear();
    if (i > 0 && evidence.poses_known) rig.pairs.push_back(examinePair(evidence, i, 0));
  }
  if (evidence.poses_known || rig.lidars.size() == 1) rig.machine = machineSeenBy(rig.lidars, evidence.snapshots);
  const TimeSpan span = spanOf(evidence.lidars);
  std::vector<ImuTiming> timings;
  for (ImuEvidence& imu : evidence.imus)
  {
    timings.push_back(imuTiming(imu.samples));
    std::stable_sort(imu.samples.begin(), imu.samples.end(),
                     [](const ImuSample& a, const ImuSample& b) { return a.stamp < b.stamp; });
  }
  for (std::size_t i = 0; i < timings.size(); ++i) rig.imus.push_back(examineImu(evidence.imus[i], timings[i], span));
  if (evidence.poses_known)
    for (const ImuComparison& compared : compareImus(bodyImus(evidence.imus)))
      rig.imus[compared.imu].compared = compared;

  for (std::size_t i = 1; i < rig.lidars.size(); ++i)
  {
    const ClockExamination& first = rig.lidars.front().clock;
    ClockExamination& other = rig.lidars[i].clock;
    if (first.ahead_of_host && other.ahead_of_host) other.ahead_of_first = *other.ahead_of_host - *first.ahead_of_host;
    if (first.drift && other.drift) other.drift_to_first = *other.drift - *first.drift;
  }
  return rig;
}
}  // namespace scanloom
