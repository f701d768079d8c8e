#include "base/formats/CompressedFile.h"

#include <fmt/format.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

namespace scanloom
{
namespace
{
constexpr std::size_t kBuffer = 1 << 18;  // bytes
constexpr std::uint64_t kAlways = 64 << 20, kMostRatio = 64;
constexpr std::size_t kLargestCall = 1 << 30;  // zlib counts in int
constexpr std::array<char, 4> kZstdMagic{'\x28', '\xB5', '\x2F', '\xFD'};

bool isGzip(const std::array<char, 4>& bytes) { return bytes[0] == '\x1F' && bytes[1] == '\x8B'; }

/** Throws std::runtime_error if it cannot be opened, or is no file. Opening a pipe would wait for its writer. */
std::ifstream opened(const std::filesystem::path& path)
{
  if (std::filesystem::is_directory(path)) throw std::runtime_error(path.string() + ": is a directory");
  if (std::filesystem::exists(path) && !std::filesystem::is_regular_file(path))
    throw std::runtime_error(path.string() + ": a pipe or a device can be read only once: write it to a file first");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(fmt::format("{}: {}", path.string(), std::strerror(errno)));
  return file;
}

/** Zeros behind its end. The file is at its begin afterwards. */
std::array<char, 4> firstBytesOf(std::ifstream& file)
{
  std::array<char, 4> first{};
  file.read(first.data(), first.size());
  file.clear();
  file.seekg(0);
  return first;
}
}  // namespace

class CompressedFile::Source
{
 public:
  explicit Source(std::ifstream file) : file_(std::move(file)) {}
  virtual ~Source() = default;

  /** Some of the bytes that are asked for; 0 at the end; nothing if the data are damaged. */
  virtual std::optional<std::size_t> read(void* bytes, std::size_t count) = 0;
  /** At the end: it came too early. */
  virtual bool cut() const = 0;
  std::uint64_t bytesRead() const { return bytes_read_; }

 protected:
  /** Bytes of the file as they are, fewer than `count` at its end. */
  std::size_t readFile(void* bytes, std::size_t count)
  {
    file_.read(static_cast<char*>(bytes), static_cast<std::streamsize>(count));
    const auto got = static_cast<std::size_t>(file_.gcount());
    bytes_read_ += got;
    return got;
  }

 private:
  std::ifstream file_;
  std::uint64_t bytes_read_ = 0;
};

class CompressedFile::Plain : public Source
{
 public:
  using Source::Source;
  std::optional<std::size_t> read(void* bytes, std::size_t count) override { return readFile(bytes, count); }
  bool cut() const override { return false; }
};

/** By inflate(), not gzread(): of damages and cuts zlib 1.3.2's gzread() forgets some. */
class CompressedFile::Gzip : public Source
{
 public:
  explicit Gzip(std::ifstream file) : Source(std::move(file)), packed_(kBuffer)
  {
    if (inflateInit2(&stream_, kGzipOnly) != Z_OK) throw std::bad_alloc();
  }
  ~Gzip() override { inflateEnd(&stream_); }
  Gzip(const Gzip&) = delete;
  Gzip& operator=(const Gzip&) = delete;

  std::optional<std::size_t> read(void* bytes, std::size_t count) override
  {
    stream_.next_out = static_cast<Bytef*>(bytes);
    stream_.avail_out = static_cast<uInt>(std::min(count, kLargestCall));
    const uInt asked = stream_.avail_out;
    while (stream_.avail_out == asked && !damaged_ && (stream_.avail_in > 0 || refill()) && inMember())
    {
      const int result = inflate(&stream_, Z_NO_FLUSH);
      within_member_ = result != Z_STREAM_END;
      damaged_ = result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR;
    }
    const std::size_t got = asked - stream_.avail_out;
    if (got == 0 && damaged_) return std::nullopt;
    return got;
  }

  bool cut() const override { return within_member_; }

 private:
  static constexpr int kGzipOnly = 15 + 16;  // the largest window, with a gzip header

  /** Begins the next member where one has ended. Like gunzip, it ends before what is no member. */
  bool inMember()
  {
    if (within_member_) return true;
    if (*stream_.next_in != 0x1F) return false;
    within_member_ = inflateReset(&stream_) == Z_OK;
    return within_member_;
  }

  bool refill()
  {
    stream_.avail_in = static_cast<uInt>(readFile(packed_.data(), packed_.size()));
    stream_.next_in = reinterpret_cast<Bytef*>(packed_.data());
    return stream_.avail_in > 0;
  }

  std::vector<char> packed_;
  z_stream stream_{};
  bool within_member_ = false, damaged_ = false;
};

class CompressedFile::Zstd : public Source
{
 public:
  explicit Zstd(std::ifstream file)
    : Source(std::move(file)), stream_(ZSTD_createDStream(), &ZSTD_freeDStream), packed_(kBuffer)
  {
  }

  std::optional<std::size_t> read(void* bytes, std::size_t count) override
  {
    ZSTD_outBuffer out{bytes, count, 0};
    bool ended = false;
    while (out.pos == 0 && !ended)
    {
      ended = in_.pos == in_.size && !refill();  // the decoder may hold bytes all the same
      const std::size_t before = in_.pos;
      const std::size_t result = ZSTD_decompressStream(stream_.get(), &out, &in_);
      if (ZSTD_isError(result)) return std::nullopt;
      if (in_.pos > before || out.pos > 0) within_frame_ = result != 0;
    }
    return out.pos;
  }

  bool cut() const override { return within_frame_; }

 private:
  bool refill()
  {
    in_ = {packed_.data(), readFile(packed_.data(), packed_.size()), 0};
    return in_.size > 0;
  }

  std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream_;
  std::vector<char> packed_;
  ZSTD_inBuffer in_{nullptr, 0, 0};
  bool within_frame_ = false;
};

CompressedFile::CompressedFile(const std::filesystem::path& path) : path_(path)
{
  std::ifstream file = opened(path);
  const std::array<char, 4> first = firstBytesOf(file);
  if (first == kZstdMagic)
    source_ = std::make_unique<Zstd>(std::move(file));
  else if (isGzip(first))
    source_ = std::make_unique<Gzip>(std::move(file));
  else
    source_ = std::make_unique<Plain>(std::move(file));
}

CompressedFile::~CompressedFile() = default;

std::size_t CompressedFile::readUpTo(void* bytes, std::size_t count)
{
  auto* const to = static_cast<char*>(bytes);
  std::size_t done = 0;
  if (next_ && count > 0)
  {
    to[done++] = *next_;
    next_.reset();
  }
  while (done < count)
  {
    const std::optional<std::size_t> got = source_->read(to + done, count - done);
    if (!got) fail("the compressed data is damaged");
    if (*got == 0) break;
    done += *got;
    unpacked_ += *got;
    if (unpacked_ > kAlways + kMostRatio * bytesRead())
      fail("it unpacks to more than 64 times its size, as no recording does; if it is one, unpack it first");
  }
  return done;
}

void CompressedFile::read(void* bytes, std::size_t count)
{
  if (readUpTo(bytes, count) < count) fail("the file ends within an object");
}

bool CompressedFile::atEnd()
{
  char byte = 0;
  if (readUpTo(&byte, 1) == 1)
  {
    next_ = byte;
    return false;
  }
  if (source_->cut()) fail("the compressed file is cut short");
  return true;
}

std::uint64_t CompressedFile::bytesRead() const { return source_->bytesRead(); }

void CompressedFile::fail(const char* what) const
{
  throw std::runtime_error(fmt::format("{}: {}", path_.string(), what));
}

bool isCompressed(const std::filesystem::path& path)
{
  if (!std::filesystem::is_regular_file(path)) return false;  // what is read from a pipe is gone
  std::array<char, 4> bytes{};
  std::ifstream(path, std::ios::binary).read(bytes.data(), bytes.size());
  return bytes == kZstdMagic || isGzip(bytes);
}

std::uint64_t uncompressedBytes(const std::filesystem::path& path)
{
  CompressedFile file(path);
  std::vector<char> buffer(kBuffer);
  std::uint64_t bytes = 0;
  while (const std::size_t got = file.readUpTo(buffer.data(), buffer.size())) bytes += got;
  file.atEnd();
  return bytes;
}
}  // namespace scanloom
