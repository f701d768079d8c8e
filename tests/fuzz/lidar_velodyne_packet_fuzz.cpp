/**
 * Any bytes as a packet of every Velodyne model at once: what kind() accepts is decoded without exceptions; anything
 * else throws at most std::out_of_range. fuzz options: -max_len=1300
 */
#include <array>

#include "decodeAll.h"
#include "input/lidar/internal/Velodyne.h"

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

VelodyneMetadata metadataOf(const VelodyneModel& model, int returns)
{
  VelodyneMetadata m;
  m.model = &model;
  m.returns = returns;
  m.product_id = model.product_id;
  const auto lasers = static_cast<std::size_t>(model.channels);
  for (std::size_t i = 0; i < lasers; ++i) m.angles.vertical.push_back(static_cast<double>(i % 16) - 8);
  m.angles.azimuth.assign(lasers, 1.4);
  m.vertical_offset_mm.assign(lasers, -3);
  return m;
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
    if (what & kTurn) store(packet, block * 100 + 2, static_cast<std::uint16_t>(azimuth % (kTurn + 1)));
  }
  if (what & kReturns) packet[1204] = static_cast<std::uint8_t>(metadata.returns == 2 ? 0x39 : 0x37 + packet[1204] % 2);
  if (what & kModel) packet[1205] = model.product_id;
}
}  // namespace

/** The first byte tells what is corrected, the second which decoder must also refuse a packet that is too short. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const std::array<VelodyneMetadata, 5> lidars{
      metadataOf(kVelodyneModels[0], 1), metadataOf(kVelodyneModels[0], 2), metadataOf(kVelodyneModels[1], 1),
      metadataOf(kVelodyneModels[2], 2), metadataOf(kVelodyneModels[3], 1)};
  static const auto decoders = decodersOf(lidars, makeVelodyne);
  static std::vector<std::uint8_t> packet;
  if (size < 2) return 0;
  for (std::size_t i = 0; i < lidars.size(); ++i)
  {
    packet.assign(data + 2, data + size);
    mend(packet, data[0], lidars[i]);
    const auto chosen = [](std::size_t block, std::size_t blocks)
    { return block == 0 || block + 1 == blocks || block == packet[1203] % blocks; };
    if (decoders[i]->kind(packet) == PacketKind::Lidar)
      decodeAll(*decoders[i], packet, chosen);
    else if (i == data[1] % lidars.size() && packet.size() < kVelodynePacketBytes)
      refuse(*decoders[i], packet);
  }
  return 0;
}
