#include "formats/CompressedFile.h"

#include <fmt/format.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace scanloom
{
namespace
{
constexpr std::size_t kBuffer = 1 << 18;       // bytes
constexpr std::size_t kLargestCall = 1 << 30;  // zlib counts in int
constexpr std::array<char, 4> kZstdMagic{'\x28', '\xB5', '\x2F', '\xFD'};

std::array<char, 4> firstBytesOf(const std::filesystem::path& path)
{
  std::array<char, 4> bytes{};
  std::ifstream(path, std::ios::binary).read(bytes.data(), bytes.size());
  return bytes;
}
}  // namespace

class CompressedFile::Source
{
 public:
  virtual ~Source() = default;

  /** Some of the bytes that are asked for; 0 at the end; nothing if the data are damaged. */
  virtual std::optional<std::size_t> read(void* bytes, std::size_t count) = 0;
  /** At the end: it came too early. */
  virtual bool cut() const = 0;
  virtual std::uint64_t bytesRead() const = 0;
};

/** Also plain files, which zlib reads as they are. */
class CompressedFile::Gzip : public Source
{
 public:
  explicit Gzip(const std::filesystem::path& path) : file_(gzopen(path.c_str(), "rb"), &gzclose)
  {
    if (!file_) throw std::runtime_error(fmt::format("{}: {}", path.string(), std::strerror(errno)));
    gzbuffer(file_.get(), kBuffer);
  }

  std::optional<std::size_t> read(void* bytes, std::size_t count) override
  {
    const int got = gzread(file_.get(), bytes, static_cast<unsigned>(std::min(count, kLargestCall)));
    int error = Z_OK;
    gzerror(file_.get(), &error);
    // zlib 1.3.2 tells them with the last bytes, and forgets them with the next read.
    cut_ = cut_ || error == Z_BUF_ERROR;
    damaged_ = damaged_ || (error < 0 && error != Z_BUF_ERROR);
    if (got <= 0 && damaged_) return std::nullopt;
    return static_cast<std::size_t>(std::max(0, got));
  }

  bool cut() const override { return cut_; }

  std::uint64_t bytesRead() const override
  {
    return static_cast<std::uint64_t>(std::max<z_off_t>(0, gzoffset(file_.get())));
  }

 private:
  std::unique_ptr<gzFile_s, int (*)(gzFile)> file_;
  bool cut_ = false, damaged_ = false;
};

class CompressedFile::Zstd : public Source
{
 public:
  explicit Zstd(const std::filesystem::path& path)
    : file_(path, std::ios::binary), stream_(ZSTD_createDStream(), &ZSTD_freeDStream), packed_(kBuffer)
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
  std::uint64_t bytesRead() const override { return bytes_read_; }

 private:
  /** False at the end of the file. */
  bool refill()
  {
    file_.read(packed_.data(), static_cast<std::streamsize>(packed_.size()));
    in_ = {packed_.data(), static_cast<std::size_t>(file_.gcount()), 0};
    bytes_read_ += in_.size;
    return in_.size > 0;
  }

  std::ifstream file_;
  std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream_;
  std::vector<char> packed_;
  ZSTD_inBuffer in_{nullptr, 0, 0};
  bool within_frame_ = false;
  std::uint64_t bytes_read_ = 0;
};

CompressedFile::CompressedFile(const std::filesystem::path& path) : path_(path)
{
  if (firstBytesOf(path) == kZstdMagic)
    source_ = std::make_unique<Zstd>(path);
  else
    source_ = std::make_unique<Gzip>(path);
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
  const std::array<char, 4> bytes = firstBytesOf(path);
  return bytes == kZstdMagic || (bytes[0] == '\x1F' && bytes[1] == '\x8B');
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
