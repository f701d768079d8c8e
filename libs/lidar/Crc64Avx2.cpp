/** CRC-64 by carry-less multiplication, eight times 16 bytes at once: each waits seven cycles for its product. */
#include "lidar/Crc64Kernels.h"

#include <immintrin.h>

#define PCLMUL_INLINE [[gnu::target("pclmul,sse4.1"), gnu::always_inline]] inline

namespace scanloom::crc64_kernels
{
namespace
{
constexpr std::size_t kBytes = 16, kTimes = 8;
constexpr Fold kFar = foldBy(kTimes * kBytes), kNear = foldBy(kBytes);

PCLMUL_INLINE __m128i load(const std::uint8_t* bytes)
{
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes));
}

PCLMUL_INLINE __m128i load(const Fold& by)
{
  return _mm_set_epi64x(static_cast<std::int64_t>(by.second), static_cast<std::int64_t>(by.first));
}

PCLMUL_INLINE __m128i fold(__m128i folded, __m128i by, __m128i bytes)
{
  const __m128i first = _mm_clmulepi64_si128(folded, by, 0x00), second = _mm_clmulepi64_si128(folded, by, 0x11);
  return _mm_xor_si128(_mm_xor_si128(first, second), bytes);
}
}  // namespace

[[gnu::target("pclmul,sse4.1")]] std::uint64_t byPclmul(std::uint64_t crc, const std::uint8_t* bytes, std::size_t size)
{
  constexpr std::size_t kStep = kTimes * kBytes;
  if (size < kStep) return bySlices(crc, bytes, size);

  __m128i folded[kTimes];
  for (std::size_t i = 0; i < kTimes; ++i) folded[i] = load(bytes + i * kBytes);
  folded[0] = _mm_xor_si128(folded[0], _mm_set_epi64x(0, static_cast<std::int64_t>(crc)));
  const __m128i far = load(kFar), near = load(kNear);
  for (bytes += kStep, size -= kStep; size >= kStep; bytes += kStep, size -= kStep)
    for (std::size_t i = 0; i < kTimes; ++i) folded[i] = fold(folded[i], far, load(bytes + i * kBytes));

  __m128i last = folded[0];
  for (std::size_t i = 1; i < kTimes; ++i) last = fold(last, near, folded[i]);
  for (; size >= kBytes; bytes += kBytes, size -= kBytes) last = fold(last, near, load(bytes));

  std::uint8_t remaining[kBytes];
  _mm_storeu_si128(reinterpret_cast<__m128i*>(remaining), last);
  return bySlices(bySlices(0, remaining, kBytes), bytes, size);
}
}  // namespace scanloom::crc64_kernels
