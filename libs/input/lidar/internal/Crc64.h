#pragma once
#include "base/core/Bytes.h"

#include <cstdint>

namespace scanloom
{
/** CRC-64/XZ: ECMA-182 polynomial, reflected (0xC96C5795D7870F42), initial value and final xor all ones. */
std::uint64_t crc64(Bytes);
}  // namespace scanloom
