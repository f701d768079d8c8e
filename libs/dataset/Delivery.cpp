#include "dataset/Delivery.h"

#include <algorithm>
#include <set>

#include "batching/PacketNumbering.h"

namespace scanloom
{
namespace
{
void addOrder(Delivery& delivery, const PacketRun& run)
{
  std::set<std::int64_t> seen;
  std::vector<const NumberedPacket*> leaders;  // each was sent after all that had come before it
  for (const NumberedPacket& packet : run)
  {
    if (!seen.insert(packet.packet).second)
    {
      ++delivery.duplicates;
      continue;
    }
    if (leaders.empty() || packet.packet > leaders.back()->packet)
    {
      leaders.push_back(&packet);
      continue;
    }
    const auto overtook = std::upper_bound(leaders.begin(), leaders.end(), packet.packet,
                                           [](std::int64_t n, const NumberedPacket* p) { return n < p->packet; });
    ++delivery.reordered;
    delivery.displacement = std::max<std::int64_t>(delivery.displacement, leaders.end() - overtook);
    delivery.displacement_time =
        std::max(delivery.displacement_time, packet.trace->received - (*overtook)->trace->received);
  }
}

/** Blocks that the lidar passes outside of its azimuth window, turn by turn, without a word. */
int closedBlocks(const LidarDescription& lidar)
{
  int blocks = 0;
  for (int c = 0; c < lidar.columns_per_frame; ++c) blocks += inAzimuthWindow(lidar, c) ? 0 : 1;
  return blocks;
}

void addLoss(Delivery& delivery, PacketRun run, const LidarDescription& lidar)
{
  // Packets without ids do not tell a closed window from loss: a gap of that length is taken for the window.
  const int closed = lidar.numbering == Numbering::Stamps ? closedBlocks(lidar) : 0;
  const std::int64_t harmless = closed > 0 ? 1 + closed / lidar.columns_per_packet : 0;
  std::sort(run.begin(), run.end(),
            [](const NumberedPacket& a, const NumberedPacket& b) { return a.packet < b.packet; });
  for (std::size_t i = 1; i < run.size(); ++i)
  {
    const std::int64_t step = run[i].packet - run[i - 1].packet;
    if (step - 1 <= harmless) continue;
    const auto missing = static_cast<std::uint64_t>(step - 1);
    ++delivery.gaps;
    delivery.lost += missing;
    delivery.longest_gap = std::max(delivery.longest_gap, missing);
    delivery.longest_gap_time = std::max(
        delivery.longest_gap_time, (run[i].block - run[i - 1].block - lidar.columns_per_packet) * lidar.blockPeriod());
  }
}

void addRates(Delivery& delivery, const std::vector<PacketRun>& runs, const LidarDescription& lidar)
{
  const int columns = lidar.columns_per_frame - closedBlocks(lidar);
  delivery.nominal_block_rate = lidar.frame_rate * columns;
  const PacketNumbering numbering(lidar);
  delivery.nominal_packet_rate =
      lidar.numbering == Numbering::Stamps
          ? delivery.nominal_block_rate / lidar.columns_per_packet
          : lidar.frame_rate * static_cast<double>(numbering.sentBefore(numbering.packetsPerTurn()));

  Timestamp first = Timestamp::max(), last = Timestamp::min();
  for (const PacketRun& run : runs)
    for (const NumberedPacket& packet : run)
    {
      first = std::min(first, packet.trace->received);
      last = std::max(last, packet.trace->received);
    }
  if (runs.empty() || seconds(last - first) * lidar.frame_rate < 1) return;
  // n packets span n - 1 intervals.
  const double intervals = static_cast<double>(delivery.packets - 1) / static_cast<double>(delivery.packets);
  delivery.packet_rate = intervals * static_cast<double>(delivery.packets) / seconds(last - first);
  delivery.block_rate = intervals * static_cast<double>(delivery.valid_blocks) / seconds(last - first);
}
}  // namespace

Delivery deliveryOf(const std::vector<PacketRun>& runs, const LidarDescription& lidar)
{
  Delivery delivery;
  for (const PacketRun& run : runs)
  {
    delivery.packets += run.size();
    for (const NumberedPacket& packet : run)
    {
      delivery.blocks += packet.trace->blocks;
      delivery.valid_blocks += packet.trace->valid_blocks;
    }
    addOrder(delivery, run);
    addLoss(delivery, run, lidar);
  }
  delivery.restarts = runs.empty() ? 0 : runs.size() - 1;
  addRates(delivery, runs, lidar);
  return delivery;
}
}  // namespace scanloom
