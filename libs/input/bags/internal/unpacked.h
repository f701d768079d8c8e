#pragma once
#include "base/core/Bytes.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * The bytes behind a compression as bags name it: "lz4" (frames), "zstd", "bz2"; of `size` bytes. Throws
 * std::runtime_error if they are damaged, are more or fewer, or if the compression is another one. Memory grows with
 * what is unpacked, not with `size`.
 */
std::vector<std::uint8_t> unpacked(Bytes packed, const std::string& compression, std::uint64_t size);

/** A message of a bag that compresses each: zstd, with its size in its frame. Anything else is returned as empty. */
std::vector<std::uint8_t> unpackedMessage(Bytes message);

/** Whether it begins like a zstd frame, as no message does. */
bool isZstd(Bytes);
}  // namespace scanloom
