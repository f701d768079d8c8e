#pragma once
#include "source/Datagram.h"
#include "source/FileDescriptor.h"

namespace scanloom
{
/** A UDP socket of one sensor: datagrams leave from its address. */
class DatagramSender
{
 public:
  /** Throws std::runtime_error if the socket can't be opened or bound to `source`. */
  explicit DatagramSender(const IpAddress& source);

  /** To the port that the datagram names; false if the operating system refused it: too large, no buffer. */
  bool send(const Datagram&, const IpAddress& destination) const;

 private:
  FileDescriptor socket_;
};
}  // namespace scanloom
