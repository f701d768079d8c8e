/**
 * Any bytes as a packet of every Velodyne model at once: what kind() accepts is decoded without exceptions; anything
 * else throws at most std::out_of_range. fuzz options: -max_len=1300
 */
#include <array>
#include <stdexcept>

#include "input/lidar/internal/VelodyneDecoder.h"
#include "require.h"

using namespace scanloom;

namespace
{
enum Mend : std::uint8_t
{
  kSize = 1,
  kModel = 2,    // product id and the flags of its blocks
  kReturns = 4,  // a return mode that there is
  kTurn = 8,     // azimuths up to 360 degrees
};

VelodyneDecoder decoderOf(const VelodyneModel& model, int returns)
{
  VelodyneMetadata m;
  m.model = &model;
  m.returns = returns;
  m.product_id = model.product_id;
  const auto lasers = static_cast<std::size_t>(model.channels);
  for (std::size_t laser = 0; laser < lasers; ++laser) m.vertical_deg.push_back(static_cast<double>(laser % 16) - 8);
  m.azimuth_offset_deg.assign(lasers, 1.4);
  m.vertical_offset_mm.assign(lasers, -3);
  return {m, Rigid::identity()};
}

void mend(std::vector<std::uint8_t>& packet, std::uint8_t what, const VelodyneMetadata& metadata)
{
  constexpr std::array<std::uint16_t, 4> kFlags{0xEEFF, 0xDDFF, 0xCCFF, 0xBBFF};
  const VelodyneModel& model = *metadata.model;
  if (what & kSize) packet.resize(kVelodynePacketBytes);
  if (packet.size() != kVelodynePacketBytes) return;
  for (std::size_t block = 0; block < 12; ++block)
  {
    if (what & kModel) store(packet, block * 100, kFlags[model.channels == 128 ? block % 4 : 0]);
    const auto azimuth = load<std::uint16_t>(packet, block * 100 + 2);
    if (what & kTurn) store(packet, block * 100 + 2, static_cast<std::uint16_t>(azimuth % (kVelodyneTurn + 1)));
  }
  if (what & kReturns) packet[1204] = static_cast<std::uint8_t>(metadata.returns == 2 ? 0x39 : 0x37 + packet[1204] % 2);
  if (what & kModel) packet[1205] = model.product_id;
}

void decode(const VelodyneDecoder& decoder, Bytes packet)
{
  static std::vector<MeasurementBlock> blocks;
  static PointCloud points;
  const LidarDescription& d = decoder.description();
  decoder.header(packet);
  decoder.readBlocks(packet, blocks);
  points.clear();
  for (const MeasurementBlock& block : blocks)
  {
    require(block.stamp >= Timestamp{} && block.stamp < Timestamp{d.stamp_modulus});
    require(block.measurement_id < d.columns_per_frame);
    // The order holds but for the top of the hour.
    const Duration after_first = block.stamp - blocks.front().stamp;
    require(after_first >= Duration{0} || after_first < -d.stamp_modulus / 2);
    // The first, the last and one more: points take most of the time, and blocks are alike.
    if (block.index != 0 && block.index + 1u != blocks.size() && block.index != packet[1203] % blocks.size()) continue;
    const std::size_t before = points.size();
    decoder.appendPoints(packet, block.index, 0, 0, points);
    require(block.valid || points.size() == before);
    require(points.size() - before <= static_cast<std::size_t>(d.channels * d.returns));
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    require(points.range[i] > 0 && points.ring[i] < d.channels && points.t[i] >= 0 && points.t[i] < 60'000 &&
            points.position(i).allFinite());
}

void refuse(const VelodyneDecoder& decoder, Bytes packet)
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

/** The first byte tells what is corrected, the second which decoder must also refuse a packet that is too short. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const std::array<VelodyneDecoder, 5> decoders{
      decoderOf(kVelodyneModels[0], 1), decoderOf(kVelodyneModels[0], 2), decoderOf(kVelodyneModels[1], 1),
      decoderOf(kVelodyneModels[2], 2), decoderOf(kVelodyneModels[3], 1)};
  static std::vector<std::uint8_t> packet;
  if (size < 2) return 0;
  for (const VelodyneDecoder& decoder : decoders)
  {
    packet.assign(data + 2, data + size);
    mend(packet, data[0], decoder.metadata());
    if (decoder.kind(packet) == PacketKind::Lidar)
      decode(decoder, packet);
    else if (&decoder == &decoders[data[1] % decoders.size()] && packet.size() < kVelodynePacketBytes)
      refuse(decoder, packet);
  }
  return 0;
}
