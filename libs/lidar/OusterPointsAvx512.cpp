/** Sixteen channels at a time; what has no return is squeezed out by a permutation that vpcompressd makes. */
#include "lidar/OusterKernels.h"

#include <x86intrin.h>

// gcc 12 takes its own _mm512_undefined_epi32() for a mistake (GCC bug 105593).
#ifndef __clang__  // which knows no such warning
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif

#define AVX512 [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl,avx512vbmi,popcnt,prfchw")]]
#define AVX512_INLINE \
  [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl,avx512vbmi,popcnt,prfchw"), gnu::always_inline]] inline

namespace scanloom::ouster_kernels
{
namespace
{
constexpr std::size_t kLanes = 16;

/** Where lane i finds word kWord of channel i in the registers 2 kPair and 2 kPair + 1 of sixteen packed channels. */
template <int kWords, int kWord, int kPair>
struct Picked
{
  struct Lanes
  {
    alignas(64) std::int32_t from[kLanes]{};
    __mmask16 here = 0;
  };
  static constexpr Lanes make()
  {
    Lanes lanes;
    for (int i = 0; i < 16; ++i)
    {
      const int position = i * kWords + kWord;
      lanes.from[i] = position % (32);
      if (position / (32) == kPair) lanes.here = static_cast<__mmask16>(lanes.here | (1 << i));
    }
    return lanes;
  }
  static constexpr Lanes kLanesOf = make();
};

template <int kWords, int kWord, int kPair = 0>
AVX512_INLINE __m512i pick(const std::uint8_t* channels, __m512i picked)
{
  using Lanes = Picked<kWords, kWord, kPair>;
  const __m512i from = _mm512_load_si512(Lanes::kLanesOf.from);
  const __m512i low = _mm512_loadu_si512(channels + 128 * kPair);
  if constexpr (2 * kPair + 1 < kWords)
  {
    const __m512i both = _mm512_permutex2var_epi32(low, from, _mm512_loadu_si512(channels + 128 * kPair + 64));
    picked = kPair == 0 ? both : _mm512_mask_mov_epi32(picked, Lanes::kLanesOf.here, both);
  }
  else
    picked = _mm512_mask_permutexvar_epi32(picked, Lanes::kLanesOf.here, from, low);
  if constexpr (2 * kPair + 2 < kWords) return pick<kWords, kWord, kPair + 1>(channels, picked);
  return picked;
}

/** Word kWord of sixteen channels. */
template <int kWords, int kWord>
AVX512_INLINE __m512i word(const std::uint8_t* channels)
{
  if constexpr (kWords == 1) return _mm512_loadu_si512(channels);
  return pick<kWords, kWord>(channels, _mm512_setzero_si512());
}

/** A field of sixteen channels, its lowest bit at kTo of 32. */
template <std::size_t kProfile, OusterField kField, int kTo = 0>
AVX512_INLINE __m512i field(const std::uint8_t* channels)
{
  using To = Move<kProfile, kField, kTo>;
  if constexpr (!To::kPresent) return _mm512_setzero_si512();
  __m512i value = word<kWords<kProfile>, To::kWord>(channels);
  if constexpr (To::kShift < 0) value = _mm512_srli_epi32(value, -To::kShift);
  if constexpr (To::kShift > 0) value = _mm512_slli_epi32(value, To::kShift);
  if constexpr (To::kNeedsMask) value = _mm512_and_si512(value, _mm512_set1_epi32(static_cast<int>(To::kMask)));
  return value;
}

/** The column's angle and the origin of its rays: what the sixteen beams share. */
struct Column
{
  __m512 cos_th, sin_th, range_offset;
  __m512 origin[3];
};

AVX512_INLINE Column columnOf(const OusterColumnView& view, const BeamBlock& any)
{
  Column column;  // not zeroed first: gcc calls that "rep stos", which takes longer than a block of channels
  column.cos_th = _mm512_set1_ps(view.cos_th);
  column.sin_th = _mm512_set1_ps(view.sin_th);
  column.range_offset = _mm512_set1_ps(any.range_offset[0]);
  for (int k = 0; k < 3; ++k)
    column.origin[k] = _mm512_set1_ps(view.cos_th * any.d[k][0] + view.sin_th * any.e[k][0] + any.f[k][0]);
  return column;
}

AVX512_INLINE __m512 coordinate(const Column& column, const BeamBlock& beams, int k, __m512 along)
{
  const __m512 turning = _mm512_add_ps(_mm512_mul_ps(column.cos_th, _mm512_load_ps(beams.a[k])),
                                       _mm512_mul_ps(column.sin_th, _mm512_load_ps(beams.b[k])));
  return _mm512_add_ps(_mm512_mul_ps(along, _mm512_add_ps(turning, _mm512_load_ps(beams.c[k]))), column.origin[k]);
}

/** Sorts the bytes of sixteen words: all first ones, all second ones, all upper halves. */
AVX512_INLINE __m512i apart(__m512i words)
{
  alignas(64) static constexpr std::uint8_t kFrom[64] = {
      0,  4,  8,  12, 16, 20, 24, 28, 32, 36, 40, 44, 48, 52, 56, 60,  //
      1,  5,  9,  13, 17, 21, 25, 29, 33, 37, 41, 45, 49, 53, 57, 61,  //
      2,  3,  6,  7,  10, 11, 14, 15, 18, 19, 22, 23, 26, 27, 30, 31,  //
      34, 35, 38, 39, 42, 43, 46, 47, 50, 51, 54, 55, 58, 59, 62, 63};
  return _mm512_permutexvar_epi8(_mm512_load_si512(kFrom), words);
}

/** The lower halves of sixteen words; one permutation, where _mm512_cvtepi32_epi16 would be two. */
AVX512_INLINE __m256i lowerHalves(__m512i words)
{
  alignas(64) static constexpr std::uint8_t kFrom[64] = {0,  1,  4,  5,  8,  9,  12, 13, 16, 17, 20,
                                                         21, 24, 25, 28, 29, 32, 33, 36, 37, 40, 41,
                                                         44, 45, 48, 49, 52, 53, 56, 57, 60, 61};
  return _mm512_castsi512_si256(_mm512_permutexvar_epi8(_mm512_load_si512(kFrom), words));
}

/** The returns of sixteen channels go to `to`, from the n-th on. Returns how many there are. */
template <std::size_t kProfile, Return kReturn>
AVX512_INLINE std::size_t writeBlock(const std::uint8_t* channels, const Column& column, const BeamBlock& beams,
                                     __m512i rings, PointRoom to, std::size_t n)
{
  __m512i range = field<kProfile, OusterField::Range>(channels);
  __mmask16 seen = _mm512_test_epi32_mask(range, range);
  if constexpr (kReturn == Return::Second)
  {
    // A second return where the first one is, is the first one.
    const __m512i second = field<kProfile, OusterField::Range2>(channels);
    seen = _mm512_mask_cmpneq_epi32_mask(_mm512_test_epi32_mask(second, second), second, range);
    range = second;
  }
  const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m512i order = _mm512_maskz_compress_epi32(seen, lanes);
  const __m512i small = _mm512_ternarylogic_epi32((field<kProfile, Fields<kReturn>::kReflectivity>(channels)),
                                                  (field<kProfile, OusterField::NearIr, 16>(channels)), rings, 0xFE);
  const __m512i apart_small = apart(_mm512_permutexvar_epi32(order, small));
  const __m512 along = _mm512_sub_ps(_mm512_cvtepi32_ps(range), column.range_offset);

  fetchWideFields(to, n);
  _mm512_storeu_ps(to.x + n, _mm512_permutexvar_ps(order, coordinate(column, beams, 0, along)));
  _mm512_storeu_ps(to.y + n, _mm512_permutexvar_ps(order, coordinate(column, beams, 1, along)));
  _mm512_storeu_ps(to.z + n, _mm512_permutexvar_ps(order, coordinate(column, beams, 2, along)));
  _mm512_storeu_si512(to.range + n, _mm512_permutexvar_epi32(order, range));
  __m256i signal = _mm256_setzero_si256();
  if constexpr (Move<kProfile, Fields<kReturn>::kSignal>::kPresent)
    signal = lowerHalves(_mm512_permutexvar_epi32(order, field<kProfile, Fields<kReturn>::kSignal>(channels)));
  _mm256_storeu_epi16(to.signal + n, signal);
  _mm256_storeu_epi16(to.near_ir + n, _mm512_extracti64x4_epi64(apart_small, 1));
  _mm_storeu_epi8(to.intensity + n, _mm512_castsi512_si128(apart_small));
  _mm_storeu_epi8(to.ring + n, _mm512_extracti32x4_epi32(apart_small, 1));
  return static_cast<std::size_t>(_mm_popcnt_u32(seen));
}

/** The channels of the last block where there are fewer than a vector holds. */
template <std::size_t kProfile, Return kReturn>
[[gnu::noinline]] AVX512 std::size_t writeLast(const std::uint8_t* channels, std::size_t count, const Column& column,
                                               const BeamBlock& beams, __m512i rings, PointRoom to, std::size_t n)
{
  constexpr std::size_t kBytes = kOusterProfiles[kProfile].channel_bytes;
  alignas(64) std::uint8_t filled_up[kLanes * kBytes] = {};  // channels that are not there have no return
  std::memcpy(filled_up, channels, count * kBytes);
  return writeBlock<kProfile, kReturn>(filled_up, column, beams, rings, to, n);
}

template <std::size_t kProfile, Return kReturn>
AVX512 std::size_t writeReturn(const OusterColumnView& view, const BeamBlock* blocks, std::size_t beams, PointRoom to,
                               std::size_t n)
{
  constexpr std::size_t kBytes = kOusterProfiles[kProfile].channel_bytes;
  fetchNarrowFields(to, n);
  const Column column = columnOf(view, *blocks);
  const std::uint8_t* channels = view.channels;
  __m512i rings = _mm512_slli_epi32(_mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15), 8);
  for (; beams >= kLanes; beams -= kLanes, channels += kLanes * kBytes, ++blocks)
  {
    n += writeBlock<kProfile, kReturn>(channels, column, *blocks, rings, to, n);
    rings = _mm512_add_epi32(rings, _mm512_set1_epi32(kLanes << 8));
  }
  if (beams > 0) n += writeLast<kProfile, kReturn>(channels, beams, column, *blocks, rings, to, n);
  return n;
}

AVX512 void writeShared(const OusterColumnView& view, PointRoom to, std::size_t n)
{
  const __m512i t = _mm512_set1_epi32(view.t);
  const __m512i column = _mm512_set1_epi16(static_cast<short>(view.measurement_id));
  const __m512i sensor_id = _mm512_set1_epi8(static_cast<char>(view.sensor_id));
  for (std::size_t i = 0; i < n; i += 16) _mm512_storeu_si512(to.t + i, t);
  for (std::size_t i = 0; i < n; i += 32) _mm512_storeu_si512(to.column + i, column);
  for (std::size_t i = 0; i < n; i += 64) _mm512_storeu_si512(to.sensor_id + i, sensor_id);
}

template <std::size_t kProfile>
AVX512 std::size_t write(const OusterColumnView& view, const BeamBlock* blocks, std::size_t beams, const PointRoom& to)
{
  std::size_t n = writeReturn<kProfile, Return::First>(view, blocks, beams, to, 0);
  if constexpr (kOusterProfiles[kProfile].returns() == 2)
    n = writeReturn<kProfile, Return::Second>(view, blocks, beams, to, n);
  writeShared(view, to, n);
  return n;
}

template <std::size_t... kRows>
constexpr Table makeTable(std::index_sequence<kRows...>)
{
  return {&write<kRows>...};
}
}  // namespace

const Table kAvx512 = makeTable(std::make_index_sequence<kOusterProfiles.size()>());
}  // namespace scanloom::ouster_kernels
