#pragma once
#include "core/Time.h"
#include "source/IpAddress.h"

#include <vector>

namespace scanloom
{
/** What one UDP datagram brought, and when it was received. */
struct Datagram
{
  Timestamp received;  // clock of the recording computer
  IpAddress source;
  std::uint16_t source_port = 0;
  std::uint16_t destination_port = 0;
  std::vector<std::uint8_t> payload;
};
}  // namespace scanloom
