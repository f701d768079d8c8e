/**
 * What the kernels of crc64 have in common. Bytes are the coefficients of a polynomial, the first byte's lowest bit the
 * highest power. To fold is to replace 16 bytes by 16 bytes further on that leave the same remainder: Gopal et al.,
 * "Fast CRC computation for generic polynomials using PCLMULQDQ instruction", Intel 2009.
 */
#pragma once
#include <cstddef>
#include <cstdint>

namespace scanloom::crc64_kernels
{
constexpr std::uint64_t kPolynomial = 0xC96C5795D7870F42;

/** The remainder of `crc` followed by `size` bytes, by tables of 16 bytes at once. No complements: that is crc64(). */
std::uint64_t bySlices(std::uint64_t crc, const std::uint8_t* bytes, std::size_t size);

/** The same by folding 128 (256) bytes at once. */
std::uint64_t byPclmul(std::uint64_t crc, const std::uint8_t* bytes, std::size_t size);
std::uint64_t byVpclmul(std::uint64_t crc, const std::uint8_t* bytes, std::size_t size);

/** x^n modulo the polynomial. */
constexpr std::uint64_t power(std::size_t n)
{
  std::uint64_t remainder = std::uint64_t{1} << 63;
  for (; n > 0; --n) remainder = (remainder & 1) ? (remainder >> 1) ^ kPolynomial : remainder >> 1;
  return remainder;
}

/** What the first and the second eight of 16 bytes are multiplied by to be moved on by `bytes`. */
struct Fold
{
  std::uint64_t first, second;
};

/** One power less: the product of two reflected words of 64 bits comes out one bit too low. */
constexpr Fold foldBy(std::size_t bytes) { return {power(8 * bytes + 63), power(8 * bytes - 1)}; }
}  // namespace scanloom::crc64_kernels
