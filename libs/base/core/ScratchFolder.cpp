#include "base/core/ScratchFolder.h"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>
#include <system_error>

namespace scanloom
{
ScratchFolder::ScratchFolder(const std::filesystem::path& parent, const std::string& name)
{
  std::string made = (parent / (name + "_XXXXXX")).string();
  if (!::mkdtemp(made.data())) throw std::runtime_error(fmt::format("cannot write into {}", parent.string()));
  path_ = made;
}

ScratchFolder::~ScratchFolder()
{
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}
}  // namespace scanloom
