#pragma once
#include "base/core/Bytes.h"
#include "base/core/Time.h"
#include "input/packets/IpAddress.h"

#include <vector>

namespace scanloom
{
/** A UDP datagram with its time of receipt. */
struct Datagram
{
  Timestamp received;  // clock of the recording computer
  IpAddress source;
  std::uint16_t source_port = 0;
  std::uint16_t destination_port = 0;
  std::vector<std::uint8_t> payload;
};

/** A datagram that does not own its bytes. */
struct DatagramView
{
  Timestamp received;
  IpAddress source;
  std::uint16_t source_port = 0;
  std::uint16_t destination_port = 0;
  Bytes payload;

  DatagramView() = default;
  DatagramView(const Datagram& d)  // NOLINT: implicit, as Bytes from a vector
    : received(d.received),
      source(d.source),
      source_port(d.source_port),
      destination_port(d.destination_port),
      payload(d.payload)
  {
  }
};
}  // namespace scanloom
