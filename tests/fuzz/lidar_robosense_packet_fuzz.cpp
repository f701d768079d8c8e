/**
 * Any bytes as a packet of every Robosense model, chosen by the input: what kind() accepts is decoded without
 * exceptions; anything else throws at most std::out_of_range. fuzz options: -max_len=1300
 */
#include <stdexcept>
#include <string>

#include "input/lidar/internal/RobosenseDecoder.h"
#include "require.h"

using namespace scanloom;

namespace
{
enum Mend : std::uint8_t
{
  kSize = 1,
  kMarkers = 2,  // of header and blocks, and the unit
  kModel = 4,
  kTurn = 8,  // azimuths below 360 degrees
  kTime = 16,
};

std::vector<RobosenseDecoder> everyDecoder()
{
  std::vector<RobosenseDecoder> decoders;
  for (const RobosenseModel& model : kRobosenseModels)
    for (const int returns : {1, 2})
    {
      RobosenseMetadata metadata;
      metadata.model = &model;
      metadata.returns = returns;
      metadata.angles.vertical.resize(static_cast<std::size_t>(model.channels));
      metadata.angles.azimuth = metadata.angles.vertical;
      decoders.emplace_back(metadata, Rigid::identity());
    }
  return decoders;
}

void mendMarker(std::vector<std::uint8_t>& packet, std::uint32_t marker)
{
  for (std::size_t i = 0; i < 4; ++i) packet[i] = static_cast<std::uint8_t>(marker >> 8 * (3 - i));
}

void mend(std::vector<std::uint8_t>& packet, std::uint8_t what, const RobosenseMetadata& metadata)
{
  if (what & kSize) packet.resize(kRobosensePacketBytes);
  if (packet.size() < kRobosensePacketBytes) return;
  if (what & kMarkers) mendMarker(packet, metadata.model->marker);
  if (what & kMarkers) packet[17] &= 1;
  if (what & kModel) packet[30] = metadata.model->type;
  if (what & kModel) packet[31] = metadata.model->version;
  for (std::size_t block = 42; block < 1242; block += 100)
  {
    if (what & kMarkers) store(packet, block, std::uint16_t{0xEEFF});
    if (what & kTurn) packet[block + 2] = static_cast<std::uint8_t>(packet[block + 2] % 140);
  }
  if (what & kTime) store(packet, 20, std::uint16_t{0});
  if (what & kTime) packet[26] = packet[27] = 0;
}

void decode(const RobosenseDecoder& decoder, Bytes packet)
{
  static std::vector<MeasurementBlock> blocks;
  static PointCloud points;
  const LidarDescription& d = decoder.description();
  decoder.header(packet);
  decoder.readBlocks(packet, blocks);
  points.clear();
  for (const MeasurementBlock& block : blocks)
  {
    require(block.measurement_id < d.columns_per_frame);
    require(!block.valid || (nanoseconds(block.stamp) >= 0 && nanoseconds(block.stamp) < std::int64_t{1} << 62));
    require(block.stamp >= blocks.front().stamp);
    const std::size_t before = points.size();
    decoder.appendPoints(packet, block.index, 0, 0, points);
    require(block.valid || points.size() == before);
    require(points.size() - before <= static_cast<std::size_t>(d.channels * d.returns));
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    require(points.range[i] > 0 && points.ring[i] < d.channels && points.t[i] >= 0 && points.t[i] < 55'560 &&
            points.position(i).allFinite());
}

void refuse(const RobosenseDecoder& decoder, Bytes packet)
{
  try
  {
    decode(decoder, packet);
  }
  catch (const std::out_of_range&)
  {
  }
}
}  // namespace

/** The first byte tells what is corrected, the second which decoder must read the rest. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const std::vector<RobosenseDecoder> decoders = everyDecoder();
  static std::vector<std::uint8_t> packet;
  if (size < 2) return 0;
  const RobosenseDecoder& decoder = decoders[data[1] % decoders.size()];
  packet.assign(data + 2, data + size);
  mend(packet, data[0], decoder.metadata());
  if (decoder.kind(packet) == PacketKind::Lidar)
    decode(decoder, packet);
  else if (packet.size() < kRobosensePacketBytes)
    refuse(decoder, packet);
  return 0;
}
