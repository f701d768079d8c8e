/** A Hesai data packet (blocks of one reading per channel, date and time, return mode), read by firing of all channels.
 */
#pragma once
#include "base/core/Bytes.h"
#include "input/lidar/internal/HesaiModels.h"

#include <optional>

namespace scanloom
{
constexpr int kHesaiTurn = 36000;  // azimuths count hundredths of a degree, clockwise from above

struct HesaiReading
{
  std::uint32_t range_mm = 0;  // 0: no return
  std::uint8_t reflectivity = 0;
};

/** Time and direction of a firing of all channels. */
struct HesaiFiring
{
  Duration after_stamp{0};              // of its first shot; negative where packets are stamped at their end
  int azimuth = 0;                      // hundredths of a degree; below 36000
  const std::int32_t* shots = nullptr;  // by channel, ns; see HesaiModel
  bool valid = false;
};

/** A view of the bytes. Throws std::out_of_range for fewer than model.packetBytes(). */
class HesaiPacket
{
 public:
  HesaiPacket(Bytes packet, const HesaiModel& model);

  /** By what the header says: channels, blocks and version of the protocol. True for packets without a header. */
  bool isOfModel() const;

  /** Whether markers, unit and return mode are such that the rest can be read. */
  bool isSound() const;

  /** 0 for a return mode that is not known. */
  int returns() const { return returns_; }

  /** UTC as the sensor knows it; nothing if there is no such date and time. */
  std::optional<Timestamp> stamp() const;

  std::size_t firings() const { return static_cast<std::size_t>(model_.blocks) / perFiring(); }
  HesaiFiring firing(std::size_t index) const;

  /** `which` return: 0, or 1 in packets with two. */
  HesaiReading reading(std::size_t firing, std::size_t channel, std::size_t which) const;

 private:
  std::size_t perFiring() const { return returns_ == 0 ? 1 : static_cast<std::size_t>(returns_); }
  Bytes block(std::size_t index) const;
  Bytes tail() const { return packet_.slice(model_.tailAt(), model_.tail.bytes); }

  Bytes packet_;
  const HesaiModel& model_;
  int returns_ = 0;
  std::uint32_t unit_mm_ = 4;
};

/** ns of the first shot within a block: channels fire in an order of their own. */
std::int32_t firstHesaiShot(const std::int32_t* shots, int channels);
}  // namespace scanloom
