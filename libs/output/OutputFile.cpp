#include "output/OutputFile.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace scanloom
{
OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)), temporary_(path_.string() + ".part")
{
  errno = 0;
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_) throw std::runtime_error(fmt::format("cannot write '{}': {}", path_.string(), std::strerror(errno)));
}

OutputFile::~OutputFile()
{
  stream_.close();
  std::error_code ignored;  // after commit() there is nothing to remove
  std::filesystem::remove(temporary_, ignored);
}

void OutputFile::commit()
{
  errno = 0;
  stream_.close();
  if (!stream_) throw std::runtime_error(fmt::format("cannot finish '{}': {}", path_.string(), std::strerror(errno)));
  std::filesystem::rename(temporary_, path_);
}
}  // namespace scanloom
