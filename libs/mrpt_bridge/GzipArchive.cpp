#include "mrpt_bridge/GzipArchive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
constexpr std::size_t kLargestCall = 1 << 30;  // zlib counts in int
}

GzipArchive GzipArchive::writing(const std::filesystem::path& path, int level)
{
  return {path, gzopen(path.c_str(), fmt::format("wb{}", level).c_str())};
}

GzipArchive GzipArchive::writing(int descriptor, const std::filesystem::path& path, int level)
{
  return {path, gzdopen(descriptor, fmt::format("wb{}", level).c_str())};
}

GzipArchive::GzipArchive(const std::filesystem::path& path, gzFile opened) : path_(path), file_(opened)
{
  if (!file_) throw std::runtime_error(fmt::format("{}: {}", path.string(), std::strerror(errno)));
  gzbuffer(file_, 1 << 18);
}

GzipArchive::GzipArchive(GzipArchive&& other) noexcept : path_(std::move(other.path_)), file_(other.file_)
{
  other.file_ = nullptr;
}

GzipArchive::~GzipArchive()
{
  if (file_) gzclose(file_);
}

void GzipArchive::endMember()
{
  if (gzflush(file_, Z_FINISH) != Z_OK) fail(std::strerror(errno));
}

void GzipArchive::close()
{
  if (!file_) return;
  const int result = gzclose(std::exchange(file_, nullptr));
  if (result != Z_OK) fail(result == Z_ERRNO ? std::strerror(errno) : "closing failed");
}

std::size_t GzipArchive::write(const void* bytes, std::size_t count)
{
  const auto* next = static_cast<const char*>(bytes);
  for (std::size_t left = count; left > 0;)
  {
    const auto chunk = std::min(left, kLargestCall);
    if (gzwrite(file_, next, static_cast<unsigned>(chunk)) <= 0) fail(std::strerror(errno));
    next += chunk;
    left -= chunk;
  }
  return count;
}

std::size_t GzipArchive::read(void*, std::size_t) { throw std::logic_error("a GzipArchive is for writing"); }

void GzipArchive::fail(const std::string& what) const
{
  throw std::runtime_error(fmt::format("{}: {}", path_.string(), what));
}
}  // namespace scanloom
