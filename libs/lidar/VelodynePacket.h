/** What a Velodyne data packet holds, by firing sequence: 12 blocks of 32 readings, stamp, return mode, product id. */
#pragma once
#include "core/Bytes.h"
#include "lidar/VelodyneModels.h"

namespace scanloom
{
constexpr std::size_t kVelodynePacketBytes = 1206;
constexpr std::size_t kVelodynePositionBytes = 512;  // GPS sentence and housekeeping, on a port of its own
constexpr int kVelodyneTurn = 36000;                 // azimuths count hundredths of a degree, clockwise from above

struct VelodyneReading
{
  std::uint32_t range_mm = 0;  // 0: no return
  std::uint8_t reflectivity = 0;
};

/** When and where to a sequence fires. */
struct VelodyneSequence
{
  Duration after_first{0};  // of its first shot, after the packet's first one
  double azimuth = 0;       // at its first shot, in hundredths of a degree; below 36000
  bool valid = false;
};

/**
 * A view: throws std::out_of_range on fewer than kVelodynePacketBytes. Two returns come as pairs of data blocks with
 * one azimuth: such a packet has half as many sequences with two readings per laser.
 */
class VelodynePacket
{
 public:
  VelodynePacket(Bytes packet, const VelodyneModel& model, double rpm);

  /** Return mode, block flags and model fit together. */
  bool isSound() const;

  bool hasTwoReturns() const { return mode_ == 0x39; }
  std::uint8_t productId() const;
  std::uint32_t microseconds() const;  // of the hour, at the first shot (VLS-128: a little after it)

  std::size_t sequences() const { return groups_ * sequences_per_group_; }
  VelodyneSequence sequence(std::size_t index) const;

  /** Hundredths of a degree per ns, over this packet. */
  double rate() const { return rate_; }

  /** `which`: 0, or 1 where there are two returns. */
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
  std::size_t blocks_per_group_ = 1;     // data blocks that share one azimuth
  std::size_t sequences_per_group_ = 1;  // two where a block holds 16 lasers twice
  std::size_t groups_ = 12;
  Duration group_period_;
  double nominal_rate_ = 0, rate_ = 0;
  std::size_t first_behind_gap_ = 12;  // group
  std::int64_t gap_periods_ = 0;
};
}  // namespace scanloom
