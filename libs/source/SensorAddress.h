#pragma once
#include "source/IpAddress.h"

#include <cstdint>
#include <string>

namespace scanloom
{
/** Where a sensor's web interface listens; its packets come from the same IP address, from whatever port. */
struct SensorAddress
{
  static constexpr std::uint16_t kHttpPort = 80;

  IpAddress ip;
  std::uint16_t port = kHttpPort;

  /**
   * "10.5.6.101", "fe80::1", "10.5.6.101:8080" or "[fe80::1]:8080". Host names are refused: looking them up may block
   * for longer than any time limit given here. Throws std::invalid_argument on anything else.
   */
  static SensorAddress parse(const std::string&);

  /** As parse() reads it; without the port where that is 80. */
  std::string text() const;
};
}  // namespace scanloom
