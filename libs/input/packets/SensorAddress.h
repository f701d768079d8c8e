#pragma once
#include "input/packets/IpAddress.h"

#include <cstdint>
#include <string>

namespace scanloom
{
/** Address of a sensor's web interface. Its packets come from the same IP address, from any port. */
struct SensorAddress
{
  static constexpr std::uint16_t kHttpPort = 80;

  IpAddress ip;
  std::uint16_t port = kHttpPort;

  /**
   * From "10.5.6.101", "fe80::1", "10.5.6.101:8080" or "[fe80::1]:8080". Throws std::invalid_argument for any other
   * text. Host names are refused: a look-up may block for longer than any time limit.
   */
  static SensorAddress parse(const std::string&);

  /** As parse() reads it; without the port if it is 80. */
  std::string text() const;
};
}  // namespace scanloom
