#include "base/core/fileNameOf.h"

#include <fmt/format.h>

namespace scanloom
{
std::string fileNameOf(const std::string& label)
{
  constexpr unsigned char kSpace = 0x20, kDelete = 0x7f;
  std::string name;
  for (const char c : label)
  {
    const auto byte = static_cast<unsigned char>(c);
    const bool hides = c == '.' && name.empty();
    const bool safe = byte >= kSpace && byte != kDelete && c != '/' && c != '\\' && c != '%' && !hides;
    name += safe ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return name;
}
}  // namespace scanloom
