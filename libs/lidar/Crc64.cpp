#include "lidar/Crc64.h"

#include <array>

namespace scanloom
{
namespace
{
constexpr std::uint64_t kPolynomial = 0xC96C5795D7870F42;
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

std::uint64_t crc64(Bytes bytes)
{
  std::uint64_t crc = ~std::uint64_t{0};
  const std::uint8_t* p = bytes.begin();
  for (; bytes.end() - p >= 16; p += 16)
  {
    std::uint64_t low, high;
    std::memcpy(&low, p, 8);
    std::memcpy(&high, p + 8, 8);
    crc = slice8(low ^ crc, 8) ^ slice8(high, 0);
  }
  for (; p != bytes.end(); ++p) crc = kTables[0][(crc ^ *p) & 0xFF] ^ (crc >> 8);
  return ~crc;
}
}  // namespace scanloom
