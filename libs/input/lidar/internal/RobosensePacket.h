/** A Robosense data packet (MSOP: header, 12 blocks of 32 readings, big-endian), read by firing of all channels. */
#pragma once
#include "base/core/Bytes.h"
#include "input/lidar/internal/RobosenseModels.h"

#include <optional>

namespace scanloom
{
constexpr std::size_t kRobosensePacketBytes = 1248;  // of data packets and of those about the device (DIFOP)
constexpr int kRobosenseTurn = 36000;                // azimuths count hundredths of a degree, clockwise from above

/** Whether it begins as a packet about the device does (DIFOP). */
bool isRobosenseDeviceInfo(Bytes packet);

struct RobosenseReading
{
  std::uint16_t counts = 0;  // of the packet's unit; 0: no return
  std::uint8_t reflectivity = 0;
};

/** Time and direction of a firing of all channels. */
struct RobosenseFiring
{
  Duration after_stamp{0};  // of its first shot
  double azimuth = 0;       // of its first shot, in hundredths of a degree; below 36000
  bool valid = false;
};

/** A view of the bytes. Throws std::out_of_range for fewer than kRobosensePacketBytes. `returns`: 1 or 2. */
class RobosensePacket
{
 public:
  RobosensePacket(Bytes packet, const RobosenseModel& model, int returns, double rpm);

  /** Whether its header names the model. */
  bool isOfModel() const;

  /** Whether markers, unit and azimuths fit a packet with so many returns. */
  bool isSound() const;

  /** By the sensor's clock; nothing if there is no such time. */
  std::optional<Timestamp> stamp() const;

  double unitMm() const
  {
    if (model_.unit_mm > 0) return model_.unit_mm;
    return packet_[17] == 1 ? 2.5 : 5;
  }

  std::size_t firings() const { return kRobosenseReadings / (channels_ * returns_); }
  RobosenseFiring firing(std::size_t index) const;

  /** Rate of rotation within this packet, hundredths of a degree per ns. */
  double rate() const { return rate_; }

  /** `which` return: 0, or 1 in packets with two. */
  RobosenseReading reading(std::size_t firing, std::size_t channel, std::size_t which) const;

 private:
  std::optional<Timestamp> secondsStamp() const;
  std::optional<Timestamp> calendarStamp() const;
  Bytes block(std::size_t index) const;
  int azimuth(std::size_t block) const;
  std::size_t blocksPerAzimuth() const { return channels_ == 32 ? returns_ : 1; }
  Duration periodOfAzimuth() const;
  int step(std::size_t block) const;
  double measuredRate(double nominal) const;

  Bytes packet_;
  const RobosenseModel& model_;
  std::size_t channels_, returns_;
  double rate_ = 0;
};
}  // namespace scanloom
