#pragma once
#include "base/core/Bytes.h"
#include "base/core/Time.h"
#include "input/packets/IpAddress.h"

#include <string>
#include <string_view>
#include <vector>

namespace scanloom
{
/** What a sensor sent: a UDP datagram, or a packet of a bag's message, which has a topic instead of ports. */
struct Datagram
{
  Timestamp received;  // clock of the recording computer
  IpAddress source;
  std::uint16_t source_port = 0;
  std::uint16_t destination_port = 0;
  std::vector<std::uint8_t> payload;
  std::string topic{};  // empty: a datagram
};

/** A datagram that does not own its bytes. */
struct DatagramView
{
  Timestamp received;
  IpAddress source;
  std::uint16_t source_port = 0;
  std::uint16_t destination_port = 0;
  Bytes payload;
  std::string_view topic;

  DatagramView() = default;
  DatagramView(const Datagram& d)  // NOLINT: implicit, as Bytes from a vector
    : received(d.received),
      source(d.source),
      source_port(d.source_port),
      destination_port(d.destination_port),
      payload(d.payload),
      topic(d.topic)
  {
  }
};
}  // namespace scanloom
