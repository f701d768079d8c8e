#include "input/lidar/internal/RobosensePacket.h"

#include "input/lidar/internal/calendarTime.h"

#include <cmath>

namespace scanloom
{
namespace
{
constexpr std::size_t kHeaderBytes = 42, kSizeOfBlock = 100, kReadingsOfBlock = 32;
constexpr int kLargestStep = 100;                       // of azimuths; more is a gap in the field of view
constexpr std::uint64_t kSecondsOf62Bits = 4611686018;  // stamps have 62 bits
constexpr int kCentury = 2000;                          // years count from it

std::uint64_t loadBigEndian(Bytes bytes, std::size_t offset, std::size_t count)
{
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes.slice(offset, count)) value = value << 8 | byte;
  return value;
}
}  // namespace

bool isRobosenseDeviceInfo(Bytes packet)
{
  return packet.size() == kRobosensePacketBytes && loadBigEndian(packet, 0, 8) == 0xA5FF005A11115555;
}

RobosensePacket::RobosensePacket(Bytes packet, const RobosenseModel& model, int returns, double rpm)
  : packet_(packet.slice(0, kRobosensePacketBytes)),
    model_(model),
    channels_(static_cast<std::size_t>(model.channels)),
    returns_(static_cast<std::size_t>(returns))
{
  rate_ = measuredRate(rpm / 60 * kRobosenseTurn * 1e-9);
}

Bytes RobosensePacket::block(std::size_t index) const
{
  return packet_.slice(kHeaderBytes + index * kSizeOfBlock, kSizeOfBlock);
}

int RobosensePacket::azimuth(std::size_t block) const
{
  return static_cast<int>(loadBigEndian(this->block(block), 2, 2));
}

bool RobosensePacket::isOfModel() const
{
  // Manuals put the type into byte 31, the sensor at hand into byte 30.
  const std::size_t at = packet_[30] != 0 ? 30 : 31;
  const std::uint8_t type = packet_[at], version = packet_[at + 1];
  return version == 0 ? type == model_.old_type : type == model_.type && version == model_.version;
}

bool RobosensePacket::isSound() const
{
  if (loadBigEndian(packet_, 0, 4) != model_.marker || (model_.unit_mm == 0 && packet_[17] > 1)) return false;
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < kRobosenseBlocks; ++i)
  {
    if (loadBigEndian(block(i), 0, 2) != 0xFFEE) return false;
    if (i % 2 == 1 && azimuth(i) == azimuth(i - 1)) ++pairs;
  }
  return (pairs == kRobosenseBlocks / 2) == (blocksPerAzimuth() == 2);
}

std::optional<Timestamp> RobosensePacket::stamp() const
{
  return model_.clock == RobosenseClock::Calendar ? calendarStamp() : secondsStamp();
}

std::optional<Timestamp> RobosensePacket::calendarStamp() const
{
  const Bytes date = packet_.slice(20, 6);
  const auto milliseconds = loadBigEndian(packet_, 26, 2), microseconds = loadBigEndian(packet_, 28, 2);
  const std::optional<Timestamp> second =
      timestampOf({kCentury + date[0], date[1], date[2], date[3], date[4], date[5]});
  if (!second || milliseconds >= 1000 || microseconds >= 1000) return std::nullopt;
  return *second + std::chrono::milliseconds{milliseconds} + std::chrono::microseconds{microseconds};
}

std::optional<Timestamp> RobosensePacket::secondsStamp() const
{
  const std::uint64_t seconds = loadBigEndian(packet_, 20, 6), microseconds = loadBigEndian(packet_, 26, 4);
  if (seconds >= kSecondsOf62Bits || microseconds >= 1'000'000) return std::nullopt;
  return Timestamp{std::chrono::seconds{seconds} + std::chrono::microseconds{microseconds}};
}

Duration RobosensePacket::periodOfAzimuth() const
{
  const std::size_t firings_per_azimuth = kReadingsOfBlock * blocksPerAzimuth() / (channels_ * returns_);
  return model_.sequence * static_cast<std::int64_t>(firings_per_azimuth);
}

int RobosensePacket::step(std::size_t block) const
{
  const int step = (azimuth(block + blocksPerAzimuth()) - azimuth(block)) % kRobosenseTurn;
  return step < 0 ? step + kRobosenseTurn : step;
}

double RobosensePacket::measuredRate(double nominal) const
{
  int turned = 0, steps = 0;
  for (std::size_t i = 0; i + blocksPerAzimuth() < kRobosenseBlocks; i += blocksPerAzimuth())
    if (step(i) <= kLargestStep)
    {
      turned += step(i);
      ++steps;
    }
  return turned == 0 ? nominal : turned / (static_cast<double>(periodOfAzimuth().count()) * steps);
}

RobosenseFiring RobosensePacket::firing(std::size_t index) const
{
  const std::size_t slot = index * channels_ * returns_, block = slot / kReadingsOfBlock;
  // A Helios-16P with one return gives the azimuth of every other firing.
  const double since_azimuth = slot % kReadingsOfBlock == 0 ? 0 : static_cast<double>(model_.sequence.count());
  RobosenseFiring firing;
  firing.after_stamp = model_.sequence * static_cast<std::int64_t>(index);
  for (std::size_t i = 0; i < block; i += blocksPerAzimuth())
    if (step(i) > kLargestStep)
    {
      const double firings = step(i) / (rate_ * static_cast<double>(model_.sequence.count()));
      firing.after_stamp += model_.sequence * std::lround(firings) - periodOfAzimuth();
    }
  firing.azimuth = std::fmod(azimuth(block) + rate_ * since_azimuth, kRobosenseTurn);
  firing.valid = azimuth(block) < kRobosenseTurn;
  return firing;
}

RobosenseReading RobosensePacket::reading(std::size_t firing, std::size_t channel, std::size_t which) const
{
  const std::size_t slot = (firing * returns_ + which) * channels_ + channel;
  const Bytes reading = block(slot / kReadingsOfBlock).slice(4 + 3 * (slot % kReadingsOfBlock), 3);
  return {static_cast<std::uint16_t>(loadBigEndian(reading, 0, 2)), reading[2]};
}
}  // namespace scanloom
