#include "core/OutputFile.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace scanloom
{
OutputFile::OutputFile(const std::filesystem::path& path)
  : path_(path), file_(path), stream_(file_.temporary(), std::ios::binary | std::ios::trunc)
{
}

void OutputFile::commit()
{
  errno = 0;
  stream_.close();
  if (!stream_)
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(errno)));
  file_.commit();
}
}  // namespace scanloom
