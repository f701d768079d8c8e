#pragma once
#include "input/packets/Datagram.h"
#include "input/packets/FileDescriptor.h"

namespace scanloom
{
/** A UDP socket that sends from a given address. */
class DatagramSender
{
 public:
  /** Throws std::runtime_error if the socket can't be opened or bound to `source`. */
  explicit DatagramSender(const IpAddress& source);

  /** Sends to the datagram's destination_port. False if the operating system refused: too large, no buffer. */
  bool send(const Datagram&, const IpAddress& destination) const;

 private:
  FileDescriptor socket_;
};
}  // namespace scanloom
