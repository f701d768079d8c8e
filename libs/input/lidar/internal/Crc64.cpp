#include "input/lidar/internal/Crc64.h"

#include <lzma.h>

namespace scanloom
{
std::uint64_t crc64(Bytes bytes) { return lzma_crc64(bytes.data(), bytes.size(), 0); }
}  // namespace scanloom
