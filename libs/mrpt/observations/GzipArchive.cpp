#include "mrpt/observations/GzipArchive.h"

#include "base/core/OutputFile.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <libdeflate.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <thread>

namespace scanloom
{
namespace
{
using Content = std::vector<std::uint8_t>;

// Larger ones would not be smaller together: deflate looks back 32 kB. The file does not depend on the threads.
constexpr std::size_t kMemberBytes = 1 << 18;

std::size_t mostMembers() { return 4 * std::max(1U, std::thread::hardware_concurrency()); }

Content compressed(const Content& bytes, int level)
{
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  Content member(libdeflate_gzip_compress_bound(compressor.get(), bytes.size()));
  member.resize(libdeflate_gzip_compress(compressor.get(), bytes.data(), bytes.size(), member.data(), member.size()));
  return member;
}

/** Whether level 1 leaves at most 85 %, by a sample. */
bool isCompressible(const Content& bytes)
{
  constexpr std::size_t kPieces = 4, kPiece = 4096;
  if (bytes.size() < 2 * kPieces * kPiece) return true;
  Content sample;
  for (std::size_t i = 0; i < kPieces; ++i)
  {
    const auto piece = bytes.begin() + static_cast<std::ptrdiff_t>(i * (bytes.size() - kPiece) / (kPieces - 1));
    sample.insert(sample.end(), piece, piece + kPiece);
  }
  return 100 * compressed(sample, 1).size() <= 85 * sample.size();
}

/** Level 1 is for speed: coordinates of points would take most of its time, and shrink by a tenth. */
Content memberOf(const Content& bytes, int level)
{
  return compressed(bytes, level == 1 && !isCompressible(bytes) ? 0 : level);
}
}  // namespace

GzipArchive::GzipArchive(const std::filesystem::path& path, int level)
  : GzipArchive(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666), path, level)
{
}

GzipArchive::GzipArchive(int descriptor, const std::filesystem::path& path, int level)
  : path_(path), level_(level), file_(descriptor)
{
  if (!file_.isOpen()) fail();
}

GzipArchive::~GzipArchive()
{
  if (!file_.isOpen()) return;
  try
  {
    endMember();
  }
  catch (const std::exception&)  // who wants to know calls close()
  {
  }
}

void GzipArchive::endMember()
{
  compressMember();
  while (!members_.empty()) writeOldest();
}

void GzipArchive::close()
{
  if (!file_.isOpen()) return;
  endMember();
  if (::close(file_.release()) != 0) fail();
}

std::size_t GzipArchive::write(const void* bytes, std::size_t count)
{
  const auto* next = static_cast<const std::uint8_t*>(bytes);
  for (std::size_t left = count; left > 0;)
  {
    const std::size_t part = std::min(left, kMemberBytes - member_.size());
    member_.insert(member_.end(), next, next + part);
    next += part;
    left -= part;
    if (member_.size() == kMemberBytes) compressMember();
  }
  return count;
}

std::size_t GzipArchive::read(void*, std::size_t) { throw std::logic_error("a GzipArchive is for writing"); }

void GzipArchive::compressMember()
{
  if (member_.empty()) return;
  if (members_.size() >= mostMembers()) writeOldest();
  members_.push_back(std::async(std::launch::async, &memberOf, std::move(member_), level_));
  member_ = {};
  member_.reserve(kMemberBytes);
}

void GzipArchive::writeOldest()
{
  const Bytes member = members_.front().get();
  members_.pop_front();
  for (std::size_t done = 0; done < member.size();)
  {
    const ssize_t written = ::write(file_.number(), member.data() + done, member.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail();
    done += static_cast<std::size_t>(written);
  }
}

void GzipArchive::fail() const
{
  throw std::runtime_error(fmt::format("{}: {}", path_.string(), std::strerror(errno)));
}

void writeGzip(const std::filesystem::path& path, const mrpt::serialization::CSerializable& object)
{
  constexpr int kFast = 1;
  OutputFile file(path);
  GzipArchive archive(file.temporary(), kFast);
  archive << object;
  archive.close();
  file.commit();
}
}  // namespace scanloom
