/**
 * Any bytes as a packet of every Hesai model, chosen by the input: what kind() accepts is decoded without exceptions;
 * anything else throws at most std::out_of_range. fuzz options: -max_len=1300
 */
#include <stdexcept>
#include <string>

#include "input/lidar/internal/HesaiDecoder.h"
#include "require.h"

using namespace scanloom;

namespace
{
enum Mend : std::uint8_t
{
  kSize = 1,
  kMarkers = 2,  // of header and blocks
  kReturns = 4,  // a return mode that there is
  kTurn = 8,     // azimuths up to 360 degrees
  kDate = 16,
};

std::vector<HesaiDecoder> everyDecoder()
{
  std::vector<HesaiDecoder> decoders;
  for (const HesaiModel& model : kHesaiModels)
    for (const int returns : {1, 2})
    {
      HesaiMetadata metadata;
      metadata.model = &model;
      metadata.returns = returns;
      metadata.vertical_deg.resize(static_cast<std::size_t>(model.channels));
      metadata.azimuth_offset_deg = metadata.vertical_deg;
      decoders.emplace_back(metadata, Rigid::identity());
    }
  return decoders;
}

void mendHeader(std::vector<std::uint8_t>& packet, const HesaiModel& model)
{
  if (model.header_bytes == 0) return;
  const std::size_t counts = model.header_bytes == 8 ? 2 : 6;
  store(packet, 0, std::uint16_t{0xFFEE});
  if (model.header_bytes == 12) packet[2] = model.protocol_major;
  if (model.header_bytes == 12) packet[3] = model.protocol_minor;
  packet[counts] = static_cast<std::uint8_t>(model.channels);
  packet[counts + 1] = static_cast<std::uint8_t>(model.blocks);
}

void mend(std::vector<std::uint8_t>& packet, std::uint8_t what, const HesaiMetadata& metadata)
{
  const HesaiModel& model = *metadata.model;
  if (what & kSize) packet.resize(model.packetBytes());
  if (packet.size() < model.packetBytes()) return;
  if (what & kMarkers) mendHeader(packet, model);
  for (int block = 0; block < model.blocks; ++block)
  {
    const std::size_t at = model.header_bytes + static_cast<std::size_t>(block) * model.blockBytes();
    if ((what & kMarkers) && model.azimuth_at != 0) store(packet, at, std::uint16_t{0xEEFF});
    const auto azimuth = load<std::uint16_t>(packet, at + model.azimuth_at);
    if (what & kTurn) store(packet, at + model.azimuth_at, static_cast<std::uint16_t>(azimuth % (kHesaiTurn + 1)));
  }
  const std::size_t tail = model.tailAt(), date = tail + model.tail.date;
  if (what & kReturns) packet[tail + model.tail.return_mode] = metadata.returns == 2 ? 0x39 : 0x37;
  if (!(what & kDate)) return;
  packet[date + 1] = static_cast<std::uint8_t>(packet[date + 1] % 12 + 1);
  packet[date + 2] = static_cast<std::uint8_t>(packet[date + 2] % 31 + 1);
  packet[date + 3] %= 24;
  packet[date + 4] %= 60;
  packet[date + 5] %= 60;
  packet[tail + model.tail.microseconds + 3] = packet[tail + model.tail.microseconds + 2] = 0;
}

void decode(const HesaiDecoder& decoder, Bytes packet)
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
    require(!block.valid || (nanoseconds(block.stamp) > 0 && nanoseconds(block.stamp) < std::int64_t{1} << 62));
    require(block.stamp >= blocks.front().stamp || !block.valid);
    const std::size_t before = points.size();
    decoder.appendPoints(packet, block.index, 0, 0, points);
    require(block.valid || points.size() == before);
    require(points.size() - before <= static_cast<std::size_t>(d.channels * d.returns));
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    require(points.range[i] > 0 && points.ring[i] < d.channels && points.t[i] >= 0 && points.t[i] < 140'000 &&
            points.position(i).allFinite());
}

void refuse(const HesaiDecoder& decoder, Bytes packet)
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
  static const std::vector<HesaiDecoder> decoders = everyDecoder();
  static std::vector<std::uint8_t> packet;
  if (size < 2) return 0;
  const HesaiDecoder& decoder = decoders[data[1] % decoders.size()];
  packet.assign(data + 2, data + size);
  mend(packet, data[0], decoder.metadata());
  if (decoder.kind(packet) == PacketKind::Lidar)
    decode(decoder, packet);
  else if (packet.size() < decoder.metadata().model->packetBytes())
    refuse(decoder, packet);
  return 0;
}
