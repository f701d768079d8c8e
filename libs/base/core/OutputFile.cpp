#include "base/core/OutputFile.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace scanloom
{
namespace
{
/** Up to and including the last line break. */
std::uintmax_t lengthOfLines(const std::filesystem::path& text)
{
  std::ifstream file(text, std::ios::binary);
  std::uintmax_t length = 0, read = 0;
  for (char c = 0; file.get(c);)
  {
    ++read;
    if (c == '\n') length = read;
  }
  return length;
}
}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path)
  : path_(path), file_(path), stream_(file_.temporary(), std::ios::binary | std::ios::trunc)
{
}

void OutputFile::flush()
{
  errno = 0;
  stream_.flush();
  requireWritten();
}

void OutputFile::commit()
{
  closeStream();
  file_.commit();
}

void OutputFile::commitConverted(const Convert& convert)
{
  closeStream();
  AtomicFile converted(path_);
  convert(file_.temporary(), converted.temporary());
  converted.commit();
}

void OutputFile::commitLines()
{
  stream_.close();
  std::filesystem::resize_file(file_.temporary(), lengthOfLines(file_.temporary()));
  file_.commit();
}

void OutputFile::closeStream()
{
  errno = 0;
  stream_.close();
  requireWritten();
}

void OutputFile::requireWritten() const
{
  if (stream_) return;
  throw std::runtime_error(fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(errno)));
}
}  // namespace scanloom
