#include "diagnosis/internal/PacketRuns.h"

#include "input/batching/PacketNumbering.h"

#include <cmath>
#include <cstdlib>

namespace scanloom
{
namespace
{
constexpr int kTurnsThatReorderingSpans = 4;

/** The value nearest to `newest` that equals `id` modulo `modulus`. */
std::int64_t unwrap(std::uint32_t id, std::int64_t newest, std::int64_t modulus)
{
  std::int64_t ahead = (static_cast<std::int64_t>(id) - newest) % modulus;
  if (ahead < -modulus / 2) ahead += modulus;
  if (ahead >= modulus / 2) ahead -= modulus;
  return newest + ahead;
}

/** Whether the stamps advanced by this number of turns: packets were lost, and the lidar was not restarted. */
bool stampsAgree(const PacketTrace& before, const PacketTrace& after, double turns, const LidarDescription& lidar)
{
  if (!before.stamp || !after.stamp || turns < 0) return false;
  const double measured = seconds(*after.stamp - *before.stamp) * lidar.frame_rate;
  return std::abs(measured - turns) < 1 + 0.01 * turns;
}

constexpr Duration kClockWasSet = 500ms;

/** Time between two packets by their stamps, or by their arrival if the clock was set in between. */
Duration elapsed(const PacketTrace& from, const PacketTrace& to)
{
  const Duration by_stamp = *to.stamp - *from.stamp, by_arrival = to.received - from.received;
  return std::chrono::abs(by_stamp - by_arrival) > kClockWasSet ? by_arrival : by_stamp;
}

std::vector<PacketRun> runByStamps(const std::vector<PacketTrace>& traces, const LidarDescription& lidar)
{
  const double packet_period = seconds(lidar.blockPeriod()) * lidar.columns_per_packet;
  const auto columns = static_cast<std::int64_t>(lidar.columns_per_frame);
  PacketRun run;
  NumberedPacket newest;
  for (const PacketTrace& trace : traces)
  {
    if (!trace.stamp) continue;
    NumberedPacket packet{trace.measurement_id, 0, &trace};
    if (!run.empty())
    {
      const double time = seconds(elapsed(*newest.trace, trace));
      packet.packet = newest.packet + std::llround(time / packet_period);
      // The rotor passes this column once a turn; the time tells in which turn.
      const double there = static_cast<double>(newest.block) + time * lidar.frame_rate * static_cast<double>(columns);
      packet.block += std::llround((there - trace.measurement_id) / static_cast<double>(columns)) * columns;
    }
    if (run.empty() || packet.packet > newest.packet) newest = packet;
    run.push_back(packet);
  }
  if (run.empty()) return {};
  return {run};
}
}  // namespace

std::vector<PacketRun> packetRuns(const std::vector<PacketTrace>& traces, const LidarDescription& lidar)
{
  if (lidar.numbering == Numbering::Stamps) return runByStamps(traces, lidar);

  const PacketNumbering numbering(lidar);
  const auto modulus = static_cast<std::int64_t>(lidar.frame_id_modulus);
  const std::int64_t columns = lidar.columns_per_frame, most = kTurnsThatReorderingSpans * columns;

  std::vector<PacketRun> runs;
  NumberedPacket newest;
  for (const PacketTrace& trace : traces)
  {
    const bool first = runs.empty();
    const std::int64_t frame = first ? trace.frame_id : unwrap(trace.frame_id, newest.block / columns, modulus);
    NumberedPacket packet{frame * columns + trace.measurement_id, 0, &trace};
    const std::int64_t jump = packet.block - newest.block;
    const bool started_again =
        !first &&
        (trace.init_id != newest.trace->init_id ||
         (std::abs(jump) > most &&
          !stampsAgree(*newest.trace, trace, static_cast<double>(jump) / static_cast<double>(columns), lidar)));
    if (started_again) packet.block = static_cast<std::int64_t>(trace.frame_id) * columns + trace.measurement_id;
    if (first || started_again) runs.emplace_back();
    packet.packet = numbering.sentBefore(packet.block / columns * numbering.packetsPerTurn() +
                                         trace.measurement_id / lidar.columns_per_packet);
    if (runs.back().empty() || packet.block > newest.block) newest = packet;
    runs.back().push_back(packet);
  }
  return runs;
}
}  // namespace scanloom
