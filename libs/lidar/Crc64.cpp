#include "lidar/Crc64.h"

#include <array>
#include <cstring>

#include "lidar/Crc64Kernels.h"

namespace scanloom
{
namespace crc64_kernels
{
namespace
{
constexpr std::size_t kSlices = 16;
using Tables = std::array<std::array<std::uint64_t, 256>, kSlices>;

constexpr Tables makeTables()
{
  Tables tables{};
  for (std::uint64_t byte = 0; byte < 256; ++byte)
  {
    std::uint64_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) ? (crc >> 1) ^ kPolynomial : crc >> 1;
    tables[0][byte] = crc;
  }
  for (std::size_t slice = 1; slice < kSlices; ++slice)
    for (std::size_t byte = 0; byte < 256; ++byte)
    {
      const std::uint64_t before = tables[slice - 1][byte];
      tables[slice][byte] = tables[0][before & 0xFF] ^ (before >> 8);
    }
  return tables;
}
constexpr Tables kTables = makeTables();

/** The part of the remainder that eight bytes add when `after` more bytes of the step follow them. */
std::uint64_t slice8(std::uint64_t word, std::size_t after)
{
  std::uint64_t crc = 0;
  for (std::size_t i = 0; i < 8; ++i) crc ^= kTables[after + 7 - i][(word >> (8 * i)) & 0xFF];
  return crc;
}
}  // namespace

std::uint64_t bySlices(std::uint64_t crc, const std::uint8_t* p, std::size_t size)
{
  const std::uint8_t* const end = p + size;
  for (; end - p >= 16; p += 16)
  {
    std::uint64_t low, high;
    std::memcpy(&low, p, 8);
    std::memcpy(&high, p + 8, 8);
    crc = slice8(low ^ crc, 8) ^ slice8(high, 0);
  }
  for (; p != end; ++p) crc = kTables[0][(crc ^ *p) & 0xFF] ^ (crc >> 8);
  return crc;
}
}  // namespace crc64_kernels

std::uint64_t crc64(Bytes bytes, Kernel kernel)
{
  const std::uint64_t ones = ~std::uint64_t{0};
  switch (kernel)
  {
    case Kernel::Avx512:
      return ~crc64_kernels::byVpclmul(ones, bytes.data(), bytes.size());
    case Kernel::Avx2:
      return ~crc64_kernels::byPclmul(ones, bytes.data(), bytes.size());
    case Kernel::Portable:
      break;
  }
  return ~crc64_kernels::bySlices(ones, bytes.data(), bytes.size());
}

std::uint64_t crc64(Bytes bytes) { return crc64(bytes, widestKernel()); }
}  // namespace scanloom
