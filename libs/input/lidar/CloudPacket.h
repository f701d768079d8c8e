/** A cloud whose points have stamps of their own, as one packet: what is left of lidars whose packets were not kept. */
#pragma once
#include "base/core/Bytes.h"
#include "base/core/Time.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
struct TimedPoint
{
  Timestamp stamp;
  float x = 0, y = 0, z = 0;  // m, in the sensor's frame
  std::uint8_t intensity = 0, ring = 0;
};

/** Points of about the same stamp. */
struct CloudColumn
{
  Timestamp stamp;  // of its first point
  std::uint32_t first = 0, points = 0;
};

/** Most columns of a packet. A cloud with more different stamps has points of several stamps in each column. */
constexpr std::size_t kCloudColumns = 4096;

/** In the order of stamps; those without finite coordinates or at the origin are left out. */
std::vector<std::uint8_t> cloudPacket(std::vector<TimedPoint>);

/** Reads what cloudPacket() wrote, and trusts nothing in it. */
class CloudPacket
{
 public:
  explicit CloudPacket(Bytes bytes) : bytes_(bytes) {}

  /** Whether it begins like one, and its lengths agree. */
  bool isSound() const;

  std::size_t columns() const;

  /** Throws std::out_of_range for a column or a point that is not there. */
  CloudColumn column(std::size_t) const;
  TimedPoint point(std::size_t) const;

 private:
  std::size_t points() const;

  Bytes bytes_;
};
}  // namespace scanloom
