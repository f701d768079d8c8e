#include "input/batching/internal/LidarStream.h"

#include "base/core/unwrapped.h"
#include "input/batching/internal/PacketConsensus.h"

#include <algorithm>

namespace scanloom
{
namespace
{
std::uint32_t flagsOf(const PacketHeader& header)
{
  return header.alert_flags | std::uint32_t{header.thermal_status} << 8 |
         std::uint32_t{header.shot_limiting_status} << 16;
}

/** By the last usable block; without one by the ids of `first`, the first block of the packet. */
PacketPlace placeOf(const PacketHeader& header, const std::vector<MeasurementBlock>& usable,
                    const MeasurementBlock& first)
{
  const MeasurementBlock& block = usable.empty() ? first : usable.back();
  PacketPlace place{header.init_id, block.frame_id, block.measurement_id, std::nullopt};
  if (!usable.empty()) place.stamp = block.stamp;
  return place;
}
}  // namespace

LidarStream::LidarStream(const LidarDescription& lidar, Duration deadline)
  : lidar_(lidar), continuity_(lidar), sequencer_(lidar, deadline)
{
}

std::optional<SequencedPacket> LidarStream::read(RoutedPacket packet, LidarCounters& count)
{
  std::vector<MeasurementBlock>& blocks = packet.blocks;
  const std::size_t all = blocks.size();
  const MeasurementBlock first = blocks.empty() ? MeasurementBlock{} : blocks.front();
  markImplausible(blocks, packet.received);
  if (lidar_.stamp_modulus > Duration{0}) unwrapStamps(blocks, packet.received);
  const std::size_t implausible = keepAgreeing(blocks, lidar_.numbering, continuity_.blockPeriod());

  const PacketPlace place = placeOf(packet.header, blocks, first);
  const Continuity::Judgement judged = continuity_.judge(place, packet.received);
  const bool doubtful = judged.verdict == Continuity::Verdict::Doubtful;
  if (doubtful && !blocks.empty())
  {
    ++count.doubtful_packets;
    return std::nullopt;
  }

  SequencedPacket read;
  read.flags = flagsOf(packet.header);
  noteBreak(judged, read, count);
  ++count.packets;
  count.alert_packets += read.flags != 0;
  count.received += all;
  count.invalid += all - implausible - blocks.size();
  count.implausible += implausible;
  if (doubtful || !isNew(judged, place, packet.received, blocks.size(), count)) return read;

  if (!blocks.empty()) first_stamp_ = std::min(first_stamp_.value_or(blocks.front().stamp), blocks.front().stamp);
  read.blocks = std::move(blocks);
  return read;
}

void LidarStream::markImplausible(std::vector<MeasurementBlock>& blocks, Timestamp received) const
{
  for (MeasurementBlock& block : blocks)
    block.valid = block.valid && block.measurement_id < lidar_.columns_per_frame && isPlausible(block.stamp, received);
}

/** To the stamp nearest to host time at first; after that nearest to the packet before. */
void LidarStream::unwrapStamps(std::vector<MeasurementBlock>& blocks, Timestamp received)
{
  const Duration round = lidar_.stamp_modulus;
  const Timestamp expected = received - delay_.value_or(Duration{0});
  for (MeasurementBlock& block : blocks)
    if (block.valid) block.stamp = unwrapped(block.stamp, round, expected);
  const auto last = std::find_if(blocks.rbegin(), blocks.rend(), [](const MeasurementBlock& b) { return b.valid; });
  if (last != blocks.rend()) delay_ = received - last->stamp;
  markImplausible(blocks, received);
}

void LidarStream::noteBreak(const Continuity::Judgement& judged, SequencedPacket& read, LidarCounters& count)
{
  if (judged.verdict == Continuity::Verdict::Restarts)
  {
    ++count.restarts;
    count.lost += blocksOf(sequencer_.restart(judged.first_block));
    first_stamp_.reset();
    read.restarted = true;
  }
  if (judged.verdict == Continuity::Verdict::ClockSteps)
  {
    ++count.clock_steps;
    sequencer_.shift(judged.step);
    if (first_stamp_) *first_stamp_ += judged.step;
    read.clock_step = judged.step;
  }
}

/** False for a packet that came before: its blocks are counted as duplicates. */
bool LidarStream::isNew(const Continuity::Judgement& judged, const PacketPlace& place, Timestamp received,
                        std::size_t usable_blocks, LidarCounters& count)
{
  switch (sequencer_.accept({judged.block, place.stamp, continuity_.blockPeriod()}, received))
  {
    case Sequencer::Verdict::New:
      return true;
    case Sequencer::Verdict::Recovered:
      count.lost -= blocksOf(1);
      return true;
    case Sequencer::Verdict::Duplicate:
      count.duplicate += usable_blocks;
      return false;
  }
  return false;
}

void LidarStream::giveUpGaps(Timestamp now, LidarCounters& count)
{
  count.lost += blocksOf(sequencer_.giveUpGaps(now));
}

void LidarStream::giveUpAllGaps(LidarCounters& count) { count.lost += blocksOf(sequencer_.finish()); }

std::uint64_t LidarStream::blocksOf(std::uint64_t packets) const
{
  return packets * static_cast<std::uint64_t>(lidar_.columns_per_packet);
}
}  // namespace scanloom
