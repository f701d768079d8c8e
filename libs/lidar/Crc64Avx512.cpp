/** CRC-64 by carry-less multiplication, four times 64 bytes at once. */
#include "lidar/Crc64Kernels.h"

#include <immintrin.h>

#define VPCLMUL [[gnu::target("avx512f,avx512dq,vpclmulqdq")]]
#define VPCLMUL_INLINE [[gnu::target("avx512f,avx512dq,vpclmulqdq"), gnu::always_inline]] inline

// gcc 12 takes its own _mm512_undefined_epi32() for a mistake (GCC bug 105593).
#ifndef __clang__  // which knows no such warning
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif

namespace scanloom::crc64_kernels
{
namespace
{
constexpr std::size_t kBytes = 64, kTimes = 4;
constexpr Fold kFar = foldBy(kTimes * kBytes), kNear = foldBy(kBytes);

VPCLMUL_INLINE __m512i load(const Fold& by)
{
  return _mm512_broadcast_i64x2(
      _mm_set_epi64x(static_cast<std::int64_t>(by.second), static_cast<std::int64_t>(by.first)));
}

VPCLMUL_INLINE __m512i fold(__m512i folded, __m512i by, __m512i bytes)
{
  const __m512i first = _mm512_clmulepi64_epi128(folded, by, 0x00), second = _mm512_clmulepi64_epi128(folded, by, 0x11);
  return _mm512_ternarylogic_epi64(first, second, bytes, 0x96);  // the exclusive or of three
}
}  // namespace

VPCLMUL std::uint64_t byVpclmul(std::uint64_t crc, const std::uint8_t* bytes, std::size_t size)
{
  constexpr std::size_t kStep = kTimes * kBytes;
  if (size < kStep) return byPclmul(crc, bytes, size);

  __m512i folded[kTimes];
  for (std::size_t i = 0; i < kTimes; ++i) folded[i] = _mm512_loadu_si512(bytes + i * kBytes);
  folded[0] = _mm512_xor_si512(folded[0], _mm512_zextsi128_si512(_mm_set_epi64x(0, static_cast<std::int64_t>(crc))));
  const __m512i far = load(kFar), near = load(kNear);
  for (bytes += kStep, size -= kStep; size >= kStep; bytes += kStep, size -= kStep)
    for (std::size_t i = 0; i < kTimes; ++i) folded[i] = fold(folded[i], far, _mm512_loadu_si512(bytes + i * kBytes));

  __m512i last = folded[0];
  for (std::size_t i = 1; i < kTimes; ++i) last = fold(last, near, folded[i]);
  for (; size >= kBytes; bytes += kBytes, size -= kBytes) last = fold(last, near, _mm512_loadu_si512(bytes));

  alignas(kBytes) std::uint8_t remaining[kBytes];
  _mm512_store_si512(remaining, last);
  return bySlices(bySlices(0, remaining, kBytes), bytes, size);
}
}  // namespace scanloom::crc64_kernels
