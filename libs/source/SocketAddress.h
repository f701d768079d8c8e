/** IP addresses as the sockets of the operating system want them. */
#pragma once
#include "source/IpAddress.h"

#include <sys/socket.h>

#include <cstdint>
#include <optional>

namespace scanloom
{
/** A sockaddr_in or sockaddr_in6 and its length. */
struct SocketAddress
{
  sockaddr_storage storage{};
  socklen_t length = 0;

  /** As AF_INET for an IPv4 address, AF_INET6 otherwise. */
  static SocketAddress of(const IpAddress&, std::uint16_t port);

  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }

  /** The zero address where the family is neither. */
  IpAddress ip() const;
  std::uint16_t port() const;
};

/** The address of this computer on its way to `remote`; nothing if there is no way. Sends nothing. */
std::optional<IpAddress> ownAddressTowards(const IpAddress& remote);
}  // namespace scanloom
