#include "mrpt_bridge/GzipArchive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

namespace scanloom
{
namespace
{
constexpr std::size_t kLargestCall = 1 << 30;  // zlib counts in int
}

GzipArchive GzipArchive::reading(const std::filesystem::path& path) { return {path, gzopen(path.c_str(), "rb")}; }

GzipArchive GzipArchive::writing(const std::filesystem::path& path, int level)
{
  return {path, gzopen(path.c_str(), fmt::format("wb{}", level).c_str())};
}

GzipArchive GzipArchive::writing(int descriptor, const std::filesystem::path& path, int level)
{
  return {path, gzdopen(descriptor, fmt::format("wb{}", level).c_str())};
}

std::uint64_t GzipArchive::uncompressedBytes(const std::filesystem::path& path)
{
  GzipArchive archive = reading(path);
  std::vector<char> buffer(1 << 18);
  std::uint64_t bytes = 0;
  while (const std::size_t got = archive.readUpTo(buffer.data(), buffer.size())) bytes += got;
  archive.atEnd();
  return bytes;
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

bool GzipArchive::atEnd()
{
  const int byte = gzgetc(file_);
  if (byte >= 0)
  {
    gzungetc(byte, file_);
    return false;
  }
  int error = Z_OK;
  gzerror(file_, &error);
  if (error != Z_OK) fail(error == Z_BUF_ERROR ? "the compressed file is cut short" : "the compressed data is damaged");
  return true;
}

std::uint64_t GzipArchive::bytesRead() const
{
  return static_cast<std::uint64_t>(std::max<z_off_t>(0, gzoffset(file_)));
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

std::size_t GzipArchive::readUpTo(void* bytes, std::size_t count)
{
  auto* next = static_cast<char*>(bytes);
  std::size_t left = count;
  while (left > 0)
  {
    const int got = gzread(file_, next, static_cast<unsigned>(std::min(left, kLargestCall)));
    if (got < 0) fail("the compressed data is damaged");
    if (got == 0) break;
    next += got;
    left -= static_cast<std::size_t>(got);
  }
  return count - left;
}

std::size_t GzipArchive::read(void* bytes, std::size_t count)
{
  if (readUpTo(bytes, count) < count) fail("the file ends within an object");
  return count;
}

void GzipArchive::fail(const std::string& what) const
{
  throw std::runtime_error(fmt::format("{}: {}", path_.string(), what));
}
}  // namespace scanloom
