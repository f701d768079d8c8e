#pragma once
#include "input/packets/FileDescriptor.h"
#include "input/packets/IpAddress.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace scanloom
{
struct UdpSocketOptions
{
  std::uint16_t port = 0;                   // 0: any free one
  std::optional<IpAddress> bind_address;    // of this computer, or of a multicast group; none: all IPv4 and IPv6
  std::size_t receive_buffer = 16'000'000;  // bytes, requested from the kernel
};

/** A socket for datagrams with the kernel's stamps and its count of losses. */
class UdpSocket
{
 public:
  /** Throws std::runtime_error with port, cause and remedy. */
  explicit UdpSocket(const UdpSocketOptions&);

  int descriptor() const { return descriptor_.number(); }
  std::uint16_t port() const { return port_; }

  /** How to allow the requested buffer; empty if the kernel granted it. */
  std::string bufferWarning() const;

  /** Datagrams for this port that the kernel dropped: no room in the buffer, or a wrong checksum. */
  std::uint64_t kernelDrops() const;

 private:
  void bindTo(const UdpSocketOptions&);
  void join(const IpAddress& group);
  void askForBuffer(std::size_t bytes);
  std::size_t grantedBuffer() const;  // bytes of datagrams and of the kernel's own overhead
  void setOption(int level, int option, int value, const char* what);

  FileDescriptor descriptor_;
  std::uint16_t port_ = 0;
  std::size_t asked_buffer_ = 0;
};
}  // namespace scanloom
