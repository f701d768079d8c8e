/**
 * Any bytes as a packet of every Robosense model, chosen by the input: what kind() accepts is decoded without
 * exceptions; anything else throws at most std::out_of_range. fuzz options: -max_len=1300
 */

#include "decodeAll.h"
#include "input/lidar/internal/Robosense.h"

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
}  // namespace

/** The first byte tells what is corrected, the second which decoder must read the rest. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const auto lidars = everyLidar<RobosenseMetadata>(kRobosenseModels);
  static const auto decoders = decodersOf(lidars, makeRobosense);
  static std::vector<std::uint8_t> packet;
  if (size < 2) return 0;
  const std::size_t chosen = data[1] % lidars.size();
  packet.assign(data + 2, data + size);
  mend(packet, data[0], lidars[chosen]);
  decodeOrRefuse(*decoders[chosen], packet, kRobosensePacketBytes);
  return 0;
}
