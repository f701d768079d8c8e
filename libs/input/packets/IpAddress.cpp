#include "input/packets/IpAddress.h"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr std::array<std::uint8_t, 12> kV4Prefix{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff};
}

IpAddress IpAddress::fromBytes(Bytes wire)
{
  if (wire.size() != 4 && wire.size() != 16) throw std::out_of_range("IpAddress: neither 4 nor 16 bytes");
  IpAddress address;
  if (wire.size() == 4) std::copy(kV4Prefix.begin(), kV4Prefix.end(), address.bytes.begin());
  std::copy(wire.begin(), wire.end(), address.bytes.end() - wire.size());
  return address;
}

IpAddress IpAddress::parse(const std::string& text)
{
  std::array<std::uint8_t, 16> wire{};
  if (inet_pton(AF_INET, text.c_str(), wire.data()) == 1) return fromBytes({wire.data(), 4});
  if (inet_pton(AF_INET6, text.c_str(), wire.data()) == 1) return fromBytes({wire.data(), 16});
  throw std::invalid_argument(fmt::format("'{}' is no IP address: write it as 192.168.1.10 or fe80::1", text));
}

bool IpAddress::isV4() const { return std::equal(kV4Prefix.begin(), kV4Prefix.end(), bytes.begin()); }

Bytes IpAddress::wire() const { return isV4() ? Bytes(bytes.data() + 12, 4) : Bytes(bytes.data(), 16); }

std::string IpAddress::text() const
{
  std::array<char, INET6_ADDRSTRLEN> text{};
  inet_ntop(isV4() ? AF_INET : AF_INET6, wire().data(), text.data(), text.size());
  return text.data();
}
}  // namespace scanloom
