#include "input/lidar/internal/OusterLayout.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace scanloom::ouster_layout_unittest
{
namespace
{
std::uint64_t bitByBit(Bytes bytes)
{
  std::uint64_t crc = ~std::uint64_t{0};
  for (const std::uint8_t byte : bytes)
  {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) ? 0xC96C5795D7870F42 : 0);
  }
  return ~crc;
}
}  // namespace

TEST(Crc64, givesTheCheckValueOfTheCatalogue)
{
  const std::string digits = "123456789";  // CRC-64/XZ in the catalogue of parametrised CRC algorithms: check value
  EXPECT_EQ(crc64({reinterpret_cast<const std::uint8_t*>(digits.data()), digits.size()}), 0x995DC9BBDF1939FAu);
}

TEST(Crc64, equalsTheDefinitionAtEveryLengthAndAlignment)
{
  std::mt19937 random(1);
  std::vector<std::uint8_t> bytes(1200);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  for (std::size_t length = 0; length < 1100; ++length)
  {
    const Bytes some{bytes.data() + length % 67, length};
    ASSERT_EQ(crc64(some), bitByBit(some)) << length;
  }
}
}  // namespace scanloom::ouster_layout_unittest
