/** IP addresses for sockets. */
#pragma once
#include "input/packets/IpAddress.h"

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

  /** AF_INET for an IPv4 address, AF_INET6 otherwise. */
  static SocketAddress of(const IpAddress&, std::uint16_t port);

  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }

  /** The zero address if the family is neither AF_INET nor AF_INET6. */
  IpAddress ip() const;
  std::uint16_t port() const;
};

/** This computer's address in the network of `remote`; nothing if there is no route. Sends no packet. */
std::optional<IpAddress> ownAddressTowards(const IpAddress& remote);
}  // namespace scanloom
