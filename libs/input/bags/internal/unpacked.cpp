#include "input/bags/internal/unpacked.h"

#include <bzlib.h>
#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr std::size_t kStep = 1 << 20;
constexpr std::uint64_t kAlways = 64 << 20;  // bytes that any chunk may have, and any file: chunks are usually some MB
constexpr std::uint64_t kRatioOfChunk = 6, kRatioOfFile = 20;

[[noreturn]] void refuse(const char* compression)
{
  throw std::runtime_error(fmt::format("its {} data are damaged", compression));
}

/** Replaces `packed` by what is left of it. @return bytes written to `room`; none if it can't go on. */
class Decompressor
{
 public:
  virtual ~Decompressor() = default;
  virtual std::size_t unpack(Bytes& packed, std::uint8_t* room, std::size_t bytes) = 0;
};

void takeFront(Bytes& bytes, std::size_t count) { bytes = bytes.slice(count, bytes.size() - count); }

class Lz4 : public Decompressor
{
 public:
  Lz4()
  {
    if (LZ4F_isError(LZ4F_createDecompressionContext(&context_, LZ4F_VERSION))) throw std::bad_alloc();
  }
  ~Lz4() override { LZ4F_freeDecompressionContext(context_); }
  Lz4(const Lz4&) = delete;
  Lz4& operator=(const Lz4&) = delete;

  std::size_t unpack(Bytes& packed, std::uint8_t* room, std::size_t bytes) override
  {
    std::size_t taken = packed.size();
    if (LZ4F_isError(LZ4F_decompress(context_, room, &bytes, packed.data(), &taken, nullptr))) refuse("lz4");
    takeFront(packed, taken);
    return bytes;
  }

 private:
  LZ4F_dctx* context_ = nullptr;
};

class Zstd : public Decompressor
{
 public:
  std::size_t unpack(Bytes& packed, std::uint8_t* room, std::size_t bytes) override
  {
    ZSTD_inBuffer in{packed.data(), packed.size(), 0};
    ZSTD_outBuffer out{room, bytes, 0};
    if (ZSTD_isError(ZSTD_decompressStream(stream_.get(), &out, &in))) refuse("zstd");
    takeFront(packed, in.pos);
    return out.pos;
  }

 private:
  std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream_{ZSTD_createDStream(), &ZSTD_freeDStream};
};

class Bzip2 : public Decompressor
{
 public:
  Bzip2()
  {
    if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK) throw std::bad_alloc();
  }
  ~Bzip2() override { BZ2_bzDecompressEnd(&stream_); }
  Bzip2(const Bzip2&) = delete;
  Bzip2& operator=(const Bzip2&) = delete;

  std::size_t unpack(Bytes& packed, std::uint8_t* room, std::size_t bytes) override
  {
    if (ended_) return 0;
    stream_.next_in = const_cast<char*>(reinterpret_cast<const char*>(packed.data()));  // it is only read
    stream_.avail_in = static_cast<unsigned>(packed.size());
    stream_.next_out = reinterpret_cast<char*>(room);
    stream_.avail_out = static_cast<unsigned>(bytes);
    const int status = BZ2_bzDecompress(&stream_);
    if (status != BZ_OK && status != BZ_STREAM_END) refuse("bz2");
    ended_ = status == BZ_STREAM_END;
    takeFront(packed, packed.size() - stream_.avail_in);
    return bytes - stream_.avail_out;
  }

 private:
  bz_stream stream_{};
  bool ended_ = false;
};

std::unique_ptr<Decompressor> decompressorFor(const std::string& compression)
{
  if (compression == "lz4") return std::make_unique<Lz4>();
  if (compression == "zstd") return std::make_unique<Zstd>();
  if (compression == "bz2") return std::make_unique<Bzip2>();
  throw std::runtime_error(fmt::format("it is compressed by '{}'; readable are lz4, zstd and bz2", compression));
}
}  // namespace

Unpacker::Unpacker(std::uint64_t file_bytes) : left_(kAlways + kRatioOfFile * file_bytes) {}

std::vector<std::uint8_t> Unpacker::unpacked(Bytes packed, const std::string& compression, std::uint64_t size)
{
  const std::uint64_t most = kAlways + kRatioOfChunk * packed.size();
  if (size > most)
    throw std::runtime_error(fmt::format("{} bytes claim to be {}: at most {} are read", packed.size(), size, most));
  const auto decompressor = decompressorFor(compression);
  std::vector<std::uint8_t> bytes;
  std::size_t filled = 0;
  while (filled < size)
  {
    if (filled == bytes.size()) bytes.resize(std::min<std::uint64_t>(size, std::max(kStep, 2 * bytes.size())));
    const std::size_t before = packed.size();
    const std::size_t got = decompressor->unpack(packed, bytes.data() + filled, bytes.size() - filled);
    filled += got;
    if (got == 0 && packed.size() == before) break;
    if (got > left_) throw UnpacksToTooMuch();
    left_ -= got;
  }
  if (filled < size) throw std::runtime_error(fmt::format("it holds {} bytes of the {} that it claims", filled, size));
  return bytes;
}

std::vector<std::uint8_t> Unpacker::unpackedMessage(Bytes message)
{
  const unsigned long long size = ZSTD_getFrameContentSize(message.data(), message.size());
  if (size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR) return {};
  return unpacked(message, "zstd", size);
}

UnpacksToTooMuch::UnpacksToTooMuch()
  : std::runtime_error(fmt::format("it unpacks to more than {} times its size", kRatioOfFile))
{
}

bool isZstd(Bytes bytes) { return bytes.size() >= 4 && load<std::uint32_t>(bytes, 0) == ZSTD_MAGICNUMBER; }
}  // namespace scanloom
