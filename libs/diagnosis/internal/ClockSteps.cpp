#include "diagnosis/internal/ClockSteps.h"

#include <algorithm>

namespace scanloom
{
namespace
{
// Share of the time between two packets by which a motor that starts, or is jolted, may be off.
constexpr double kRotorTolerance = 0.02;

PacketRun bySendingOrder(PacketRun run)
{
  run.erase(std::remove_if(run.begin(), run.end(), [](const NumberedPacket& p) { return !p.trace->stamp; }), run.end());
  std::sort(run.begin(), run.end(), [](const NumberedPacket& a, const NumberedPacket& b) { return a.block < b.block; });
  return run;
}

struct FoundStep
{
  std::int64_t first_block;  // after the step
  ClockStep step;
};

std::vector<FoundStep> stepsOf(const PacketRun& run, const LidarDescription& lidar, Duration least)
{
  const PacketRun sent = bySendingOrder(run);
  std::vector<FoundStep> steps;
  for (std::size_t i = 1; i < sent.size(); ++i)
  {
    const Timestamp before = *sent[i - 1].trace->stamp, after = *sent[i].trace->stamp;
    const Duration expected = (sent[i].block - sent[i - 1].block) * lidar.blockPeriod();
    const Duration excess = after - before - expected;
    const Duration tolerance = std::max(least, fromSeconds(kRotorTolerance * seconds(expected)));
    if (std::chrono::abs(excess) > tolerance) steps.push_back({sent[i].block, {before, excess}});
  }
  return steps;
}
}  // namespace

std::vector<ClockStep> clockSteps(const std::vector<PacketRun>& runs, const LidarDescription& lidar, Duration least)
{
  std::vector<ClockStep> steps;
  for (const PacketRun& run : runs)
    for (const FoundStep& found : stepsOf(run, lidar, least)) steps.push_back(found.step);
  return steps;
}

std::vector<Arrival> arrivalsOn(const std::vector<PacketRun>& runs, const LidarDescription& lidar, Duration least_step)
{
  std::vector<Arrival> arrivals;
  if (runs.empty()) return arrivals;
  const std::vector<FoundStep> steps = stepsOf(runs.back(), lidar, least_step);
  for (const NumberedPacket& packet : runs.back())
  {
    if (!packet.trace->stamp) continue;
    Timestamp stamp = *packet.trace->stamp;
    for (const FoundStep& later : steps)
      if (packet.block < later.first_block) stamp += later.step.size;
    arrivals.push_back({stamp, packet.trace->received});
  }
  return arrivals;
}
}  // namespace scanloom
