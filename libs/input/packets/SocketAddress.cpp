#include "input/packets/SocketAddress.h"

#include "input/packets/FileDescriptor.h"

#include <netinet/in.h>

#include <cstddef>
#include <cstring>

namespace scanloom
{
SocketAddress SocketAddress::of(const IpAddress& ip, std::uint16_t port)
{
  SocketAddress address;
  if (ip.isV4())
  {
    sockaddr_in v4{};
    v4.sin_family = AF_INET;
    v4.sin_port = htons(port);
    std::memcpy(&v4.sin_addr, ip.wire().data(), ip.wire().size());
    std::memcpy(&address.storage, &v4, sizeof v4);
    address.length = sizeof v4;
  }
  else
  {
    sockaddr_in6 v6{};
    v6.sin6_family = AF_INET6;
    v6.sin6_port = htons(port);
    std::memcpy(&v6.sin6_addr, ip.bytes.data(), ip.bytes.size());
    std::memcpy(&address.storage, &v6, sizeof v6);
    address.length = sizeof v6;
  }
  return address;
}

IpAddress SocketAddress::ip() const
{
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&storage);
  if (storage.ss_family == AF_INET) return IpAddress::fromBytes({bytes + offsetof(sockaddr_in, sin_addr), 4});
  if (storage.ss_family == AF_INET6) return IpAddress::fromBytes({bytes + offsetof(sockaddr_in6, sin6_addr), 16});
  return {};
}

std::uint16_t SocketAddress::port() const
{
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&storage);
  static_assert(offsetof(sockaddr_in, sin_port) == offsetof(sockaddr_in6, sin6_port));
  return static_cast<std::uint16_t>(bytes[offsetof(sockaddr_in, sin_port)] << 8 |
                                    bytes[offsetof(sockaddr_in, sin_port) + 1]);
}

std::optional<IpAddress> ownAddressTowards(const IpAddress& remote)
{
  constexpr std::uint16_t kAnyPort = 9;  // connecting a UDP socket only looks up the route
  const SocketAddress target = SocketAddress::of(remote, kAnyPort);
  const FileDescriptor socket(::socket(target.storage.ss_family, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  SocketAddress own;
  own.length = sizeof own.storage;
  if (!socket.isOpen() || ::connect(socket.number(), target.get(), target.length) != 0 ||
      ::getsockname(socket.number(), reinterpret_cast<sockaddr*>(&own.storage), &own.length) != 0)
    return std::nullopt;
  return own.ip();
}
}  // namespace scanloom
