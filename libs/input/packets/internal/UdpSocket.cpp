#include "input/packets/internal/UdpSocket.h"

#include "input/packets/SocketAddress.h"

#include <fmt/format.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
std::string remedyFor(int error, const UdpSocketOptions& options)
{
  switch (error)
  {
    case EADDRINUSE:
      return fmt::format("another program receives there: 'ss -lunp sport = :{}' names it", options.port);
    case EACCES:
    case EPERM:
      return options.port < 1024 ? "ports below 1024 need the capability CAP_NET_BIND_SERVICE: let the lidar send to a "
                                   "higher one"
                                 : "a policy of this system (SELinux, AppArmor, a container) forbids it";
    case EADDRNOTAVAIL:
      return fmt::format(
          "{} is no address of this computer: 'ip address' lists them; leave bind_address empty to "
          "receive on all",
          options.bind_address ? options.bind_address->text() : "the wildcard address");
    case EMFILE:
    case ENFILE:
      return "too many files are open: raise 'ulimit -n'";
    default:
      return "no remedy is known";
  }
}

std::runtime_error failure(const UdpSocketOptions& options, const std::string& what, int error)
{
  return std::runtime_error(
      fmt::format("UDP port {}: {}: {}: {}", options.port, what, std::strerror(error), remedyFor(error, options)));
}

bool isMulticast(const IpAddress& address)
{
  const std::uint8_t first = *address.wire().begin();
  return address.isV4() ? first >= 224 && first <= 239 : first == 0xff;
}

int familyOf(const UdpSocketOptions& options)
{
  if (options.bind_address) return options.bind_address->isV4() ? AF_INET : AF_INET6;
  const FileDescriptor probe(::socket(AF_INET6, SOCK_DGRAM, 0));  // the kernel may lack IPv6
  return probe.isOpen() ? AF_INET6 : AF_INET;
}
}  // namespace

UdpSocket::UdpSocket(const UdpSocketOptions& options)
  : descriptor_(::socket(familyOf(options), SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)), port_(options.port)
{
  if (!descriptor_.isOpen()) throw failure(options, "cannot be opened", errno);
  askForBuffer(options.receive_buffer);
  setOption(SOL_SOCKET, SO_TIMESTAMPNS, 1, "time stamps");
  setOption(SOL_SOCKET, SO_RXQ_OVFL, 1, "count of losses");
  bindTo(options);
}

void UdpSocket::bindTo(const UdpSocketOptions& options)
{
  const int family = familyOf(options);
  const bool any = !options.bind_address;
  if (family == AF_INET6) setOption(IPPROTO_IPV6, IPV6_V6ONLY, any ? 0 : 1, "IPv4 beside IPv6");
  const IpAddress wildcard = family == AF_INET ? IpAddress::parse("0.0.0.0") : IpAddress{};
  const SocketAddress own = SocketAddress::of(options.bind_address.value_or(wildcard), options.port);
  if (::bind(descriptor(), own.get(), own.length) != 0) throw failure(options, "cannot be received on", errno);
  if (!any && isMulticast(*options.bind_address)) join(*options.bind_address);

  SocketAddress bound;
  bound.length = sizeof bound.storage;
  ::getsockname(descriptor(), reinterpret_cast<sockaddr*>(&bound.storage), &bound.length);
  port_ = bound.port();
}

void UdpSocket::join(const IpAddress& group)
{
  int result = 0;
  if (group.isV4())
  {
    ip_mreqn request{};
    std::memcpy(&request.imr_multiaddr, group.wire().data(), 4);
    result = ::setsockopt(descriptor(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request);
  }
  else
  {
    ipv6_mreq request{};
    std::memcpy(&request.ipv6mr_multiaddr, group.wire().data(), 16);
    result = ::setsockopt(descriptor(), IPPROTO_IPV6, IPV6_ADD_MEMBERSHIP, &request, sizeof request);
  }
  if (result != 0)
    throw std::runtime_error(
        fmt::format("UDP port {}: multicast group {} cannot be joined: {}: add a route to it ('ip "
                    "route add {} dev INTERFACE')",
                    port_, group.text(), std::strerror(errno), group.text()));
}

void UdpSocket::askForBuffer(std::size_t bytes)
{
  asked_buffer_ = bytes;
  const int value = static_cast<int>(std::min<std::size_t>(bytes, 1 << 30));
  // SO_RCVBUFFORCE ignores net.core.rmem_max, but needs CAP_NET_ADMIN.
  if (::setsockopt(descriptor(), SOL_SOCKET, SO_RCVBUFFORCE, &value, sizeof value) != 0)
    setOption(SOL_SOCKET, SO_RCVBUF, value, "receive buffer");
}

void UdpSocket::setOption(int level, int option, int value, const char* what)
{
  if (::setsockopt(descriptor(), level, option, &value, sizeof value) != 0)
    throw std::runtime_error(fmt::format("UDP port {}: this kernel has no {}: {}", port_, what, std::strerror(errno)));
}

std::size_t UdpSocket::grantedBuffer() const
{
  int value = 0;
  socklen_t size = sizeof value;
  ::getsockopt(descriptor(), SOL_SOCKET, SO_RCVBUF, &value, &size);
  return static_cast<std::size_t>(value) / 2;  // the kernel reports the double: socket(7)
}

std::string UdpSocket::bufferWarning() const
{
  const std::size_t granted = grantedBuffer();
  if (granted >= asked_buffer_) return "";
  return fmt::format(
      "UDP port {}: the kernel granted a receive buffer of {:.1f} MB instead of {:.1f} MB: 'sysctl -w "
      "net.core.rmem_max={}' (and the same in /etc/sysctl.d/) allows it",
      port_, 1e-6 * static_cast<double>(granted), 1e-6 * static_cast<double>(asked_buffer_), asked_buffer_);
}

std::uint64_t UdpSocket::kernelDrops() const
{
  std::array<std::uint32_t, SK_MEMINFO_VARS> info{};
  socklen_t size = sizeof info;
  if (::getsockopt(descriptor(), SOL_SOCKET, SO_MEMINFO, info.data(), &size) != 0) return 0;
  return info[SK_MEMINFO_DROPS];
}
}  // namespace scanloom
