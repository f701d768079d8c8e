/** A Velodyne data packet (12 blocks of 32 readings, stamp, return mode, product id), read by firing sequence. */
#pragma once
#include "base/core/Bytes.h"
#include "input/lidar/internal/VelodyneModels.h"

namespace scanloom
{
constexpr std::size_t kVelodynePacketBytes = 1206;
constexpr std::size_t kVelodynePositionBytes = 512;  // position packets: GPS sentence and housekeeping, on another port
constexpr int kVelodyneTurn = 36000;                 // azimuths count hundredths of a degree, clockwise from above

struct VelodyneReading
{
  std::uint32_t range_mm = 0;  // 0: no return
  std::uint8_t reflectivity = 0;
};

/** Time and direction of a firing sequence. */
struct VelodyneSequence
{
  Duration after_first{0};  // time of its first shot after the first one of the packet
  double azimuth = 0;       // of its first shot, in hundredths of a degree; below 36000
  bool valid = false;
};

/**
 * A view of the bytes. Throws std::out_of_range for fewer than kVelodynePacketBytes. With two returns, pairs of data
 * blocks have the same azimuth: there are half as many sequences, with two readings per laser.
 */
class VelodynePacket
{
 public:
  VelodynePacket(Bytes packet, const VelodyneModel& model, double rpm);

  /** Whether return mode, block flags and model fit together. */
  bool isSound() const;

  bool hasTwoReturns() const { return mode_ == 0x39; }
  std::uint8_t productId() const;
  std::uint32_t microseconds() const;  // of the hour, at the first shot (VLS-128: a little after it)

  std::size_t sequences() const { return groups_ * sequences_per_group_; }
  VelodyneSequence sequence(std::size_t index) const;

  /** Rate of rotation within this packet, hundredths of a degree per ns. */
  double rate() const { return rate_; }

  /** Whether the rotor's rate is the one set in the sensor: with another model's timing it would not be. */
  bool turnsAsSet() const;

  /** `which` return: 0, or 1 in packets with two. */
  VelodyneReading reading(std::size_t sequence, std::size_t laser, std::size_t which) const;

 private:
  std::uint16_t azimuthOfBlock(std::size_t block) const;
  std::uint16_t azimuth(std::size_t group) const { return azimuthOfBlock(group * blocks_per_group_); }
  int step(std::size_t group) const;
  bool isGap(int step) const;
  double measuredRate() const;
  void findGap();

  Bytes packet_;
  const VelodyneModel& model_;
  std::uint8_t mode_ = 0;
  std::size_t blocks_per_group_ = 1;     // a group: the data blocks with one azimuth
  std::size_t sequences_per_group_ = 1;  // two if a block has two sequences of 16 lasers
  std::size_t groups_ = 12;
  Duration group_period_;
  double nominal_rate_ = 0, rate_ = 0;
  std::size_t first_behind_gap_ = 12;  // the group after a gap
  std::int64_t gap_periods_ = 0;
};
}  // namespace scanloom
