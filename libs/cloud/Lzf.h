/** LZF, the compression of binary_compressed PCD files. */
#pragma once
#include "core/Bytes.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
/** Throws std::invalid_argument unless `packed` is whole and unpacks to just `size` bytes. */
std::vector<std::uint8_t> unpackLzf(Bytes packed, std::size_t size);
}  // namespace scanloom
