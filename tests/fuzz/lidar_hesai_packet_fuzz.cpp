/**
 * Any bytes as a packet of every Hesai model, chosen by the input: what kind() accepts is decoded without exceptions;
 * anything else throws at most std::out_of_range. fuzz options: -max_len=1300
 */

#include "decodeAll.h"
#include "input/lidar/internal/Hesai.h"

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

void mendHeader(std::vector<std::uint8_t>& packet, const HesaiModel& model)
{
  if (model.header_bytes == 0) return;
  const std::size_t counts = model.header_bytes == 8 ? 2 : 6;
  store(packet, 0, std::uint16_t{0xFFEE});
  if (model.header_bytes == 12) packet[2] = model.protocol_major;
  if (model.header_bytes == 12) packet[3] = model.protocol_minor;
  packet[counts] = static_cast<std::uint8_t>(model.channels);
  packet[counts + 1] = static_cast<std::uint8_t>(model.firings);
}

void mend(std::vector<std::uint8_t>& packet, std::uint8_t what, const HesaiMetadata& metadata)
{
  const HesaiModel& model = *metadata.model;
  if (what & kSize) packet.resize(model.packetBytes());
  if (packet.size() < model.packetBytes()) return;
  if (what & kMarkers) mendHeader(packet, model);
  for (int block = 0; block < model.firings; ++block)
  {
    const std::size_t at = model.header_bytes + static_cast<std::size_t>(block) * model.blockBytes();
    if ((what & kMarkers) && model.azimuth_at != 0) store(packet, at, std::uint16_t{0xEEFF});
    const auto azimuth = load<std::uint16_t>(packet, at + model.azimuth_at);
    if (what & kTurn) store(packet, at + model.azimuth_at, static_cast<std::uint16_t>(azimuth % (kTurn + 1)));
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
}  // namespace

/** The first byte tells what is corrected, the second which decoder must read the rest. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const auto lidars = everyLidar<HesaiMetadata>(kHesaiModels);
  static const auto decoders = decodersOf(lidars, makeHesai);
  static std::vector<std::uint8_t> packet;
  if (size < 2) return 0;
  const std::size_t chosen = data[1] % lidars.size();
  packet.assign(data + 2, data + size);
  mend(packet, data[0], lidars[chosen]);
  decodeOrRefuse(*decoders[chosen], packet, lidars[chosen].model->packetBytes());
  return 0;
}
