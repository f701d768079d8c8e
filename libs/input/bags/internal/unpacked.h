#pragma once
#include "base/core/Bytes.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace scanloom
{
/** A file whose chunks unpack to more than any recording does: it is not read on. */
struct UnpacksToTooMuch : std::runtime_error
{
  UnpacksToTooMuch();
};

/**
 * Unpacks the chunks and messages of one file, with memory and time that its size bounds: a chunk has at most 64 MiB
 * and 6 times its packed bytes, all together have 64 MiB and 20 times those of the file. Packets and clouds shrink to a
 * half or a third; zeros, of which a hostile file is made, to a millionth.
 */
class Unpacker
{
 public:
  explicit Unpacker(std::uint64_t file_bytes);

  /**
   * The bytes behind a compression as bags name it: "lz4" (frames), "zstd", "bz2"; of `size` bytes. Throws
   * std::runtime_error if they are damaged, more than the limits, or fewer, or if the compression is another one.
   */
  std::vector<std::uint8_t> unpacked(Bytes packed, const std::string& compression, std::uint64_t size);

  /** A message of a bag that compresses each: zstd, with its size in its frame. Anything else is returned as empty. */
  std::vector<std::uint8_t> unpackedMessage(Bytes message);

 private:
  std::uint64_t left_;
};

/** Whether it begins like a zstd frame, as no message does. */
bool isZstd(Bytes);
}  // namespace scanloom
