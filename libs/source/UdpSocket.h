#pragma once
#include "source/FileDescriptor.h"
#include "source/IpAddress.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace scanloom
{
struct UdpSocketOptions
{
  std::uint16_t port = 0;                   // 0: one that is free, as the system chooses
  std::optional<IpAddress> bind_address;    // of this computer, or a multicast group to join; none: every IPv4 and IPv6
  std::size_t receive_buffer = 16'000'000;  // bytes asked of the kernel
};

/** A socket that receives datagrams with the kernel's stamps and its count of lost ones. */
class UdpSocket
{
 public:
  /** Throws std::runtime_error with port, cause and remedy. */
  explicit UdpSocket(const UdpSocketOptions&);

  int descriptor() const { return descriptor_.number(); }
  std::uint16_t port() const { return port_; }

  /** Bytes of datagrams (with the kernel's own overhead) that may wait in the kernel. */
  std::size_t grantedBuffer() const;

  /** Empty if as much was granted as was asked for; otherwise how to get it. */
  std::string bufferWarning() const;

  /** Datagrams for this port that the kernel threw away: no room in the buffer, or a wrong check sum. */
  std::uint64_t kernelDrops() const;

 private:
  void bindTo(const UdpSocketOptions&);
  void join(const IpAddress& group);
  void askForBuffer(std::size_t bytes);
  void setOption(int level, int option, int value, const char* what);

  FileDescriptor descriptor_;
  std::uint16_t port_ = 0;
  std::size_t asked_buffer_ = 0;
};
}  // namespace scanloom
