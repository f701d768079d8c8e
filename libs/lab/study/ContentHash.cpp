#include "lab/study/ContentHash.h"

#include "base/core/Digest.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace scanloom
{
std::string contentOf(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(fmt::format("cannot read {}", path.string()));
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string hashOf(std::string_view text)
{
  return md5({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}
}  // namespace scanloom
