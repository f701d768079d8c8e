#include "diagnosis/internal/Delivery.h"

#include "input/batching/PacketNumbering.h"
#include "input/lidar/AzimuthWindow.h"

#include <algorithm>
#include <set>

namespace scanloom
{
namespace
{
void addOrder(PacketOrder& order, const PacketRun& run)
{
  std::set<std::int64_t> seen;
  std::vector<const NumberedPacket*> leaders;  // packets that were sent after all that had arrived before
  for (const NumberedPacket& packet : run)
  {
    if (!seen.insert(packet.packet).second)
    {
      ++order.duplicates;
      continue;
    }
    if (leaders.empty() || packet.packet > leaders.back()->packet)
    {
      leaders.push_back(&packet);
      continue;
    }
    const auto overtook = std::upper_bound(leaders.begin(), leaders.end(), packet.packet,
                                           [](std::int64_t n, const NumberedPacket* p) { return n < p->packet; });
    ++order.reordered;
    order.displacement = std::max<std::int64_t>(order.displacement, leaders.end() - overtook);
    order.displacement_time = std::max(order.displacement_time, packet.trace->received - (*overtook)->trace->received);
  }
}

/** Blocks of each turn outside of the azimuth window; the lidar does not send them. */
int closedBlocks(const LidarDescription& lidar)
{
  int blocks = 0;
  for (int c = 0; c < lidar.columns_per_frame; ++c) blocks += inAzimuthWindow(lidar, c) ? 0 : 1;
  return blocks;
}

void addLoss(PacketLoss& loss, PacketRun run, const LidarDescription& lidar)
{
  // Without packet ids a closed window looks like loss, so a gap of the window's length is not counted.
  const int closed = lidar.numbering == Numbering::Stamps ? closedBlocks(lidar) : 0;
  const std::int64_t harmless = closed > 0 ? 1 + closed / lidar.columns_per_packet : 0;
  std::sort(run.begin(), run.end(),
            [](const NumberedPacket& a, const NumberedPacket& b) { return a.packet < b.packet; });
  for (std::size_t i = 1; i < run.size(); ++i)
  {
    const std::int64_t step = run[i].packet - run[i - 1].packet;
    if (step - 1 <= harmless) continue;
    const auto missing = static_cast<std::uint64_t>(step - 1);
    ++loss.gaps;
    loss.packets += missing;
    loss.longest = std::max(loss.longest, missing);
    loss.longest_time =
        std::max(loss.longest_time, (run[i].block - run[i - 1].block - lidar.columns_per_packet) * lidar.blockPeriod());
  }
}

void addRates(Delivery& delivery, const std::vector<PacketRun>& runs, const LidarDescription& lidar)
{
  const int columns = lidar.columns_per_frame - closedBlocks(lidar);
  DeliveryRates& rates = delivery.rates;
  rates.nominal_blocks = lidar.frame_rate * columns;
  const PacketNumbering numbering(lidar);
  rates.nominal_packets =
      lidar.numbering == Numbering::Stamps
          ? rates.nominal_blocks / lidar.columns_per_packet
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
  rates.packets = intervals * static_cast<double>(delivery.packets) / seconds(last - first);
  rates.blocks = intervals * static_cast<double>(delivery.valid_blocks) / seconds(last - first);
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
    addOrder(delivery.order, run);
    addLoss(delivery.loss, run, lidar);
  }
  delivery.restarts = runs.empty() ? 0 : runs.size() - 1;
  addRates(delivery, runs, lidar);
  return delivery;
}
}  // namespace scanloom
