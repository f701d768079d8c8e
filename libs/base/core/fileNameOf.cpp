#include "base/core/fileNameOf.h"

#include "base/core/Digest.h"

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
  constexpr std::size_t kMost = 150;  // file systems have 255 bytes for a name, and more follows
  return name.size() <= kMost
             ? name
             : name.substr(0, kMost) + "%" + md5({reinterpret_cast<const std::uint8_t*>(label.data()), label.size()});
}
}  // namespace scanloom
