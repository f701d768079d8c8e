#include "input/packets/SensorAddress.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace scanloom
{
namespace
{
std::uint16_t parsePort(const std::string& digits, const std::string& whole)
{
  std::uint16_t port = 0;
  const char* end = digits.data() + digits.size();
  const auto [rest, error] = std::from_chars(digits.data(), end, port);
  if (error != std::errc{} || rest != end || port == 0)
    throw std::invalid_argument(fmt::format("'{}': the port must be a number from 1 to 65535", whole));
  return port;
}
}  // namespace

SensorAddress SensorAddress::parse(const std::string& text)
{
  const std::size_t bracket = text.rfind("]:");
  if (!text.empty() && text.front() == '[' && bracket != std::string::npos)
    return {IpAddress::parse(text.substr(1, bracket - 1)), parsePort(text.substr(bracket + 2), text)};

  const std::size_t colon = text.find(':');
  if (colon != std::string::npos && std::count(text.begin(), text.end(), ':') == 1)
    return {IpAddress::parse(text.substr(0, colon)), parsePort(text.substr(colon + 1), text)};
  return {IpAddress::parse(text)};
}

std::string SensorAddress::text() const
{
  if (port == kHttpPort) return ip.text();
  return fmt::format(ip.isV4() ? "{}:{}" : "[{}]:{}", ip.text(), port);
}
}  // namespace scanloom
