#include "input/lidar/internal/HesaiPacket.h"

#include "input/lidar/internal/calendarTime.h"

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr std::size_t kShortHeader = 8;
constexpr std::uint16_t kBlockMarker = 0xEEFF, kPacketMarker = 0xFFEE;  // FF EE and EE FF on the wire

/** One, two, or 0: unknown, or three of an XT32M. */
int returnsOf(std::uint8_t mode)
{
  switch (mode)
  {
    case 0x33:  // first
    case 0x34:  // second
    case 0x37:  // strongest
    case 0x38:  // last
      return 1;
    case 0x39:  // last and strongest
    case 0x3A:  // first and second
    case 0x3B:  // first and last
    case 0x3C:  // first and strongest
    case 0x3E:  // strongest and second strongest
      return 2;
    default:
      return 0;
  }
}

/** Sensors count years from 1900 or, some firmware of the 40P, from 2000. */
int yearOf(std::uint8_t byte) { return byte + (byte < 100 ? 2000 : 1900); }
}  // namespace

HesaiPacket::HesaiPacket(Bytes packet, const HesaiModel& model)
  : packet_(packet.slice(0, model.packetBytes())), model_(model), returns_(returnsOf(tail()[model.tail.return_mode]))
{
  if (model_.header_bytes != 0) unit_mm_ = packet_[model_.header_bytes == kShortHeader ? 5 : 9];
}

bool HesaiPacket::isOfModel() const
{
  if (model_.header_bytes == 0) return true;
  const std::size_t counts = model_.header_bytes == kShortHeader ? 2 : 6;
  if (packet_[counts] != model_.channels || packet_[counts + 1] != model_.blocks) return false;
  const bool any = model_.protocol_major == 0 && model_.protocol_minor == 0;
  return any || (packet_[2] == model_.protocol_major && packet_[3] == model_.protocol_minor);
}

bool HesaiPacket::isSound() const
{
  if (returns_ == 0 || unit_mm_ == 0) return false;
  if (model_.header_bytes != 0 && load<std::uint16_t>(packet_, 0) != kPacketMarker) return false;
  if (model_.azimuth_at == 0) return true;
  for (std::size_t i = 0; i < static_cast<std::size_t>(model_.blocks); ++i)
    if (load<std::uint16_t>(block(i), 0) != kBlockMarker) return false;
  return true;
}

Bytes HesaiPacket::block(std::size_t index) const
{
  return packet_.slice(model_.header_bytes + index * model_.blockBytes(), model_.blockBytes());
}

std::optional<Timestamp> HesaiPacket::stamp() const
{
  const Bytes tail = this->tail(), date = tail.slice(model_.tail.date, 6);
  const auto microseconds = load<std::uint32_t>(tail, model_.tail.microseconds);
  const std::optional<Timestamp> second = timestampOf({yearOf(date[0]), date[1], date[2], date[3], date[4], date[5]});
  if (!second || microseconds > 1'000'000) return std::nullopt;
  return *second + std::chrono::microseconds{microseconds};
}

HesaiFiring HesaiPacket::firing(std::size_t index) const
{
  const std::size_t first_block = index * perFiring();
  const auto azimuth = load<std::uint16_t>(block(first_block), model_.azimuth_at);
  std::size_t loop = 0;
  if (model_.shots[1] != nullptr)
    loop = firings() > 1 ? index % 2 : static_cast<std::size_t>(1 - (tail()[model_.tail.loop] & 1));

  HesaiFiring firing;
  firing.shots = model_.shots[loop];
  const auto from_stamp =
      static_cast<std::int64_t>(index) - (model_.stamp_begins ? 0 : static_cast<std::int64_t>(firings()) - 1);
  firing.after_stamp =
      model_.block_after_stamp + model_.block * from_stamp + Duration{firstHesaiShot(firing.shots, model_.channels)};
  firing.azimuth = azimuth % kHesaiTurn;
  firing.valid = azimuth <= kHesaiTurn;
  for (std::size_t i = 1; i < perFiring(); ++i)
    if (load<std::uint16_t>(block(first_block + i), model_.azimuth_at) != azimuth) firing.valid = false;
  return firing;
}

HesaiReading HesaiPacket::reading(std::size_t firing, std::size_t channel, std::size_t which) const
{
  const Bytes reading = block(firing * perFiring() + which)
                            .slice(model_.azimuth_at + 2 + channel * model_.reading_bytes, model_.reading_bytes);
  return {load<std::uint16_t>(reading, 0) * unit_mm_, reading[2]};
}

std::int32_t firstHesaiShot(const std::int32_t* shots, int channels)
{
  return *std::min_element(shots, shots + channels);
}
}  // namespace scanloom
