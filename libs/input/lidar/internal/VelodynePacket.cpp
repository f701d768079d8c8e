#include "input/lidar/internal/VelodynePacket.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr std::size_t kBlocks = 12, kBlockBytes = 100, kLasersPerBlock = 32, kReadingBytes = 3;
constexpr std::size_t kAzimuth = 2, kReadings = 4;                                  // within a block
constexpr std::size_t kStamp = 1200, kReturnMode = 1204, kProductId = 1205;         // within the packet
constexpr std::uint8_t kStrongest = 0x37, kDual = 0x39;                             // 0x38 is the last return
constexpr std::array<std::uint16_t, 4> kBankFlags{0xEEFF, 0xDDFF, 0xCCFF, 0xBBFF};  // lasers 0-31, 32-63, ...

// Rotors turn at up to 20 Hz. A faster step is a gap: the jump over the part of a turn that is switched off.
constexpr double kFastestRate = 24.0 * kVelodyneTurn * 1e-9;

// If the measured rate is this close to the set one, the set one is the more exact.
constexpr double kGoverned = 0.02;

// Blocks of an HDL-32E, read as those of a VLP-16, seem to turn at 0.42 times the rate.
constexpr double kAsSet = 0.1;
}  // namespace

VelodynePacket::VelodynePacket(Bytes packet, const VelodyneModel& model, double rpm)
  : packet_(packet.slice(0, kVelodynePacketBytes)),
    model_(model),
    mode_(packet_[kReturnMode]),
    nominal_rate_(rpm / 60 * kVelodyneTurn * 1e-9)
{
  const auto channels = static_cast<std::size_t>(model.channels);
  blocks_per_group_ = std::max<std::size_t>(1, channels / kLasersPerBlock) * (hasTwoReturns() ? 2 : 1);
  sequences_per_group_ = std::max<std::size_t>(1, kLasersPerBlock / channels);
  groups_ = kBlocks / blocks_per_group_;
  group_period_ = model.sequence * static_cast<int>(sequences_per_group_);
  rate_ = measuredRate();
  findGap();
}

std::uint16_t VelodynePacket::azimuthOfBlock(std::size_t block) const
{
  return load<std::uint16_t>(packet_, block * kBlockBytes + kAzimuth);
}

std::uint8_t VelodynePacket::productId() const { return packet_[kProductId]; }

bool VelodynePacket::turnsAsSet() const { return std::abs(rate_ - nominal_rate_) <= kAsSet * nominal_rate_; }

std::uint32_t VelodynePacket::microseconds() const { return load<std::uint32_t>(packet_, kStamp); }

bool VelodynePacket::isSound() const
{
  if (mode_ < kStrongest || mode_ > kDual || (hasTwoReturns() && !model_.dual_return)) return false;
  const std::size_t banks = std::max<std::size_t>(1, static_cast<std::size_t>(model_.channels) / kLasersPerBlock);
  for (std::size_t block = 0; block < kBlocks; ++block)
    if (load<std::uint16_t>(packet_, block * kBlockBytes) != kBankFlags[block % banks]) return false;
  return true;
}

/** Azimuth from this group to the next one; negative if the encoder went back a little. */
int VelodynePacket::step(std::size_t group) const
{
  const int forwards = (azimuth(group + 1) - azimuth(group) + 2 * kVelodyneTurn) % kVelodyneTurn;
  const bool trembled = !isGap(kVelodyneTurn - forwards);
  return trembled ? forwards - kVelodyneTurn : forwards;
}

bool VelodynePacket::isGap(int step) const { return step > kFastestRate * static_cast<double>(group_period_.count()); }

double VelodynePacket::measuredRate() const
{
  int turned = 0, periods = 0;
  for (std::size_t group = 0; group + 1 < groups_; ++group)
  {
    const int step = this->step(group);
    if (isGap(step)) continue;
    turned += step;
    ++periods;
  }
  return periods == 0 ? nominal_rate_ : turned / (periods * static_cast<double>(group_period_.count()));
}

/**
 * If part of the turn is switched off, a packet continues after the gap, and only the azimuth tells how long the gap
 * was. It is a whole number of periods, since lasers fire at all times. Rounded down: a stamp that is a little too
 * early is better than one after the next packet's. Two gaps in one packet are damage.
 */
void VelodynePacket::findGap()
{
  const bool governed = std::abs(rate_ - nominal_rate_) < kGoverned * nominal_rate_;
  const double rotor_rate = governed ? nominal_rate_ : std::max(rate_, nominal_rate_);
  int gaps = 0;
  for (std::size_t group = 0; group + 1 < groups_; ++group)
  {
    const int step = this->step(group);
    if (!isGap(step)) continue;
    ++gaps;
    first_behind_gap_ = group + 1;
    gap_periods_ = static_cast<std::int64_t>(step / (rotor_rate * static_cast<double>(group_period_.count()))) - 1;
  }
  if (gaps != 1) gap_periods_ = 0;
}

VelodyneSequence VelodynePacket::sequence(std::size_t index) const
{
  const std::size_t group = index / sequences_per_group_, within = index % sequences_per_group_;
  const Duration in_group = model_.sequence * static_cast<int>(within);
  const std::int64_t periods = static_cast<std::int64_t>(group) + (group >= first_behind_gap_ ? gap_periods_ : 0);
  const double azimuth = this->azimuth(group) + rate_ * static_cast<double>(in_group.count());

  VelodyneSequence sequence;
  sequence.after_first = group_period_ * periods + in_group;
  sequence.azimuth = azimuth - kVelodyneTurn * std::floor(azimuth / kVelodyneTurn);
  sequence.valid = this->azimuth(group) <= kVelodyneTurn;  // sensors do send 360.00 degrees
  for (std::size_t block = 1; block < blocks_per_group_; ++block)
    if (azimuthOfBlock(group * blocks_per_group_ + block) != this->azimuth(group)) sequence.valid = false;
  return sequence;
}

VelodyneReading VelodynePacket::reading(std::size_t sequence, std::size_t laser, std::size_t which) const
{
  const std::size_t returns = hasTwoReturns() ? 2 : 1;
  const std::size_t number = sequence * static_cast<std::size_t>(model_.channels) + laser;  // in the order of firing
  const std::size_t block = number / kLasersPerBlock * returns + which;
  const Bytes reading = packet_.slice(block * kBlockBytes + kReadings + number % kLasersPerBlock * kReadingBytes, 3);
  return {static_cast<std::uint32_t>(load<std::uint16_t>(reading, 0) * model_.range_unit_mm), reading[2]};
}
}  // namespace scanloom
