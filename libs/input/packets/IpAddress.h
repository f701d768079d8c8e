#pragma once
#include "base/core/Bytes.h"

#include <array>
#include <cstdint>
#include <string>

namespace scanloom
{
/** An IPv4 or IPv6 address. An IPv4 address a.b.c.d is stored as ::ffff:a.b.c.d (RFC 4291, 2.5.5.2). */
struct IpAddress
{
  std::array<std::uint8_t, 16> bytes{};  // network order

  /** From four or sixteen bytes. Throws std::out_of_range for any other length. */
  static IpAddress fromBytes(Bytes);

  /** From "10.5.6.101" or "fe80::1". Throws std::invalid_argument for any other text. */
  static IpAddress parse(const std::string&);

  bool isV4() const;

  /** The four bytes of an IPv4 or sixteen of an IPv6 address, as a view into this object. */
  Bytes wire() const;

  std::string text() const;

  bool operator==(const IpAddress& other) const { return bytes == other.bytes; }
  bool operator!=(const IpAddress& other) const { return bytes != other.bytes; }
  bool operator<(const IpAddress& other) const { return bytes < other.bytes; }
};
}  // namespace scanloom
