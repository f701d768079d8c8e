#pragma once
#include "core/Bytes.h"

#include <array>
#include <cstdint>
#include <string>

namespace scanloom
{
/** An IPv4 or IPv6 address; an IPv4 address a.b.c.d is kept as ::ffff:a.b.c.d (RFC 4291, 2.5.5.2), so both compare
 * alike. */
struct IpAddress
{
  std::array<std::uint8_t, 16> bytes{};  // network order

  /** Four bytes or sixteen; throws std::out_of_range on any other length. */
  static IpAddress fromBytes(Bytes);

  /** "10.5.6.101" or "fe80::1"; throws std::invalid_argument on anything else. */
  static IpAddress parse(const std::string&);

  bool isV4() const;

  /** The four bytes of an IPv4 address, the sixteen of an IPv6 one; a view into this object. */
  Bytes wire() const;

  std::string text() const;

  bool operator==(const IpAddress& other) const { return bytes == other.bytes; }
  bool operator!=(const IpAddress& other) const { return bytes != other.bytes; }
  bool operator<(const IpAddress& other) const { return bytes < other.bytes; }
};
}  // namespace scanloom
