/** Eight channels at a time. A permutation from a table moves those with a return to the front. */
#include "input/lidar/internal/OusterKernels.h"

#ifndef __x86_64__
const scanloom::ouster_kernels::Table scanloom::ouster_kernels::kAvx2{};  // OusterPoints refuses to use it
#else
#include <x86intrin.h>

#define AVX2 [[gnu::target("avx2,popcnt,prfchw")]]
#define AVX2_INLINE [[gnu::target("avx2,popcnt,prfchw"), gnu::always_inline]] inline

namespace scanloom::ouster_kernels
{
namespace
{
constexpr int kLanes = 8;

/** For each set of lanes their numbers, lowest first, a byte each. */
struct Orders
{
  alignas(64) std::uint8_t lanes[256][kLanes];
};
constexpr Orders makeOrders()
{
  Orders orders{};
  for (int set = 0; set < 256; ++set)
    for (int lane = 0, n = 0; lane < kLanes; ++lane)
      if (set & (1 << lane)) orders.lanes[set][n++] = static_cast<std::uint8_t>(lane);
  return orders;
}
constexpr Orders kOrders = makeOrders();

AVX2_INLINE __m256i load(const std::uint8_t* from)
{
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}

/** 16 bytes into each half: AVX2 shuffles within halves only. */
AVX2_INLINE __m256i load(const std::uint8_t* low, const std::uint8_t* high)
{
  const __m128i l = _mm_loadu_si128(reinterpret_cast<const __m128i*>(low));
  return _mm256_inserti128_si256(_mm256_castsi128_si256(l), _mm_loadu_si128(reinterpret_cast<const __m128i*>(high)), 1);
}

/** For an odd number of words per channel: word kWord of each of eight channels, each in a lane of its own. */
template <int kWords, int kWord, int kRegister = 0>
AVX2_INLINE __m256i blend(const std::uint8_t* channels, __m256i blended)
{
  constexpr auto lanes = []
  {
    int set = 0;
    for (int lane = 0; lane < kLanes; ++lane)
      if ((kRegister * kLanes + lane) % kWords == kWord) set |= 1 << lane;
    return set;
  };
  constexpr int kHere = lanes();
  blended = _mm256_blend_epi32(blended, load(channels + 32 * kRegister), kHere);
  if constexpr (kRegister + 1 < kWords) return blend<kWords, kWord, kRegister + 1>(channels, blended);
  return blended;
}

/** Word kWord of eight channels. */
template <int kWords, int kWord>
AVX2_INLINE __m256i word(const std::uint8_t* channels)
{
  if constexpr (kWords == 1) return load(channels);
  if constexpr (kWords == 2)
  {
    const __m256 even = _mm256_castsi256_ps(load(channels, channels + 32));
    const __m256 odd = _mm256_castsi256_ps(load(channels + 16, channels + 48));
    return _mm256_castps_si256(_mm256_shuffle_ps(even, odd, kWord == 0 ? 0x88 : 0xDD));
  }
  if constexpr (kWords == 4)
  {
    const __m256i c0 = load(channels, channels + 64), c1 = load(channels + 16, channels + 80);
    const __m256i c2 = load(channels + 32, channels + 96), c3 = load(channels + 48, channels + 112);
    const __m256i low = kWord < 2 ? _mm256_unpacklo_epi32(c0, c1) : _mm256_unpackhi_epi32(c0, c1);
    const __m256i high = kWord < 2 ? _mm256_unpacklo_epi32(c2, c3) : _mm256_unpackhi_epi32(c2, c3);
    return kWord % 2 == 0 ? _mm256_unpacklo_epi64(low, high) : _mm256_unpackhi_epi64(low, high);
  }
  const auto lane = [](int channel) constexpr { return (channel * kWords + kWord) % kLanes; };
  const __m256i order = _mm256_setr_epi32(lane(0), lane(1), lane(2), lane(3), lane(4), lane(5), lane(6), lane(7));
  return _mm256_permutevar8x32_epi32(blend<kWords, kWord>(channels, _mm256_setzero_si256()), order);
}

/** A field of eight channels, with its lowest bit at bit kTo. */
template <std::size_t kProfile, OusterField kField, int kTo = 0>
AVX2_INLINE __m256i field(const std::uint8_t* channels)
{
  using To = Move<kProfile, kField, kTo>;
  if constexpr (!To::kPresent) return _mm256_setzero_si256();
  __m256i value = word<kWords<kProfile>, To::kWord>(channels);
  if constexpr (To::kShift < 0) value = _mm256_srli_epi32(value, -To::kShift);
  if constexpr (To::kShift > 0) value = _mm256_slli_epi32(value, To::kShift);
  if constexpr (To::kNeedsMask) value = _mm256_and_si256(value, _mm256_set1_epi32(static_cast<int>(To::kMask)));
  return value;
}

/** Angle of the column and origin of its rays, in all lanes. */
struct Column
{
  __m256 cos_th, sin_th, range_offset;
  __m256 origin[3];
};

AVX2_INLINE Column columnOf(const OusterColumnView& view, const BeamBlock& any)
{
  Column column;  // not zeroed first: gcc makes that a slow "rep stos"
  column.cos_th = _mm256_set1_ps(view.cos_th);
  column.sin_th = _mm256_set1_ps(view.sin_th);
  column.range_offset = _mm256_set1_ps(any.range_offset[0]);
  for (int k = 0; k < 3; ++k)
    column.origin[k] = _mm256_set1_ps(view.cos_th * any.d[k][0] + view.sin_th * any.e[k][0] + any.f[k][0]);
  return column;
}

AVX2_INLINE __m256 coordinate(const Column& column, const BeamBlock& beams, std::size_t first, int k, __m256 along)
{
  const __m256 turning = _mm256_add_ps(_mm256_mul_ps(column.cos_th, _mm256_load_ps(beams.a[k] + first)),
                                       _mm256_mul_ps(column.sin_th, _mm256_load_ps(beams.b[k] + first)));
  const __m256 direction = _mm256_add_ps(turning, _mm256_load_ps(beams.c[k] + first));
  return _mm256_add_ps(_mm256_mul_ps(along, direction), column.origin[k]);
}

/** Sorts the bytes of eight words: first bytes, second bytes, then upper halves. */
AVX2_INLINE __m256i apart(__m256i words)
{
  const __m256i within_halves = _mm256_setr_epi8(0, 4, 8, 12, 1, 5, 9, 13, 2, 3, 6, 7, 10, 11, 14, 15,  //
                                                 0, 4, 8, 12, 1, 5, 9, 13, 2, 3, 6, 7, 10, 11, 14, 15);
  const __m256i across = _mm256_setr_epi32(0, 4, 1, 5, 2, 3, 6, 7);
  return _mm256_permutevar8x32_epi32(_mm256_shuffle_epi8(words, within_halves), across);
}

/** Writes the returns of the eight channels from `ring` on to `to`, from the n-th point on. Returns their number. */
template <std::size_t kProfile, Return kReturn>
AVX2_INLINE std::size_t writeBlock(const std::uint8_t* channels, const Column& column, const BeamBlock& beams,
                                   std::size_t ring, PointRoom to, std::size_t n)
{
  const __m256i zero = _mm256_setzero_si256();
  __m256i range = field<kProfile, OusterField::Range>(channels);
  __m256i seen = _mm256_cmpgt_epi32(range, zero);
  if constexpr (kReturn == Return::Second)
  {
    // A second return at the range of the first is left out.
    const __m256i second = field<kProfile, OusterField::Range2>(channels);
    seen = _mm256_andnot_si256(_mm256_cmpeq_epi32(second, range), _mm256_cmpgt_epi32(second, zero));
    range = second;
  }
  const auto set = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(seen)));
  const __m128i lanes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(kOrders.lanes[set]));
  const __m256i order = _mm256_cvtepu8_epi32(lanes);

  if (ring % 16 == 0) fetchWideFields(to, n);
  const std::size_t first = ring % BeamBlock::kBeams;
  const __m256 along = _mm256_sub_ps(_mm256_cvtepi32_ps(range), column.range_offset);
  _mm256_storeu_ps(to.x + n, _mm256_permutevar8x32_ps(coordinate(column, beams, first, 0, along), order));
  _mm256_storeu_ps(to.y + n, _mm256_permutevar8x32_ps(coordinate(column, beams, first, 1, along), order));
  _mm256_storeu_ps(to.z + n, _mm256_permutevar8x32_ps(coordinate(column, beams, first, 2, along), order));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to.range + n), _mm256_permutevar8x32_epi32(range, order));

  __m256i signals = _mm256_setzero_si256();
  if constexpr (Move<kProfile, Fields<kReturn>::kSignal>::kPresent)
  {
    const __m256i signal = _mm256_permutevar8x32_epi32(field<kProfile, Fields<kReturn>::kSignal>(channels), order);
    signals = _mm256_permute4x64_epi64(_mm256_packus_epi32(signal, signal), 0x08);
  }
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to.signal + n), _mm256_castsi256_si128(signals));

  const __m256i small = _mm256_or_si256(field<kProfile, Fields<kReturn>::kReflectivity>(channels),
                                        field<kProfile, OusterField::NearIr, 16>(channels));
  const __m256i apart_small = apart(_mm256_permutevar8x32_epi32(small, order));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to.intensity + n), _mm256_castsi256_si128(apart_small));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to.near_ir + n), _mm256_extracti128_si256(apart_small, 1));
  const __m128i rings = _mm_add_epi8(lanes, _mm_set1_epi8(static_cast<char>(ring)));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to.ring + n), rings);
  return static_cast<std::size_t>(_mm_popcnt_u32(set));
}

/** The same for a last block of fewer channels. */
template <std::size_t kProfile, Return kReturn>
[[gnu::noinline]] AVX2 std::size_t writeLast(const std::uint8_t* channels, std::size_t count, const Column& column,
                                             const BeamBlock& beams, std::size_t ring, PointRoom to, std::size_t n)
{
  constexpr std::size_t kBytes = kOusterProfiles[kProfile].channel_bytes;
  alignas(64) std::uint8_t filled_up[kLanes * kBytes] = {};  // missing channels have no return
  std::memcpy(filled_up, channels, count * kBytes);
  return writeBlock<kProfile, kReturn>(filled_up, column, beams, ring, to, n);
}

template <std::size_t kProfile, Return kReturn>
AVX2 std::size_t writeReturn(const OusterColumnView& view, const BeamBlock* blocks, std::size_t beams, PointRoom to,
                             std::size_t n)
{
  constexpr std::size_t kBytes = kOusterProfiles[kProfile].channel_bytes;
  fetchNarrowFields(to, n);
  const Column column = columnOf(view, *blocks);
  const std::uint8_t* channels = view.channels;
  std::size_t ring = 0;
  for (; ring + kLanes <= beams; ring += kLanes, channels += kLanes * kBytes)
    n += writeBlock<kProfile, kReturn>(channels, column, blocks[ring / BeamBlock::kBeams], ring, to, n);
  if (ring < beams)
    n += writeLast<kProfile, kReturn>(channels, beams - ring, column, blocks[ring / BeamBlock::kBeams], ring, to, n);
  return n;
}

AVX2_INLINE void store(void* to, __m256i value) { _mm256_storeu_si256(static_cast<__m256i*>(to), value); }

AVX2 void writeShared(const OusterColumnView& view, PointRoom to, std::size_t n)
{
  const __m256i t = _mm256_set1_epi32(view.t);
  const __m256i column = _mm256_set1_epi16(static_cast<short>(view.measurement_id));
  const __m256i sensor_id = _mm256_set1_epi8(static_cast<char>(view.sensor_id));
  for (std::size_t i = 0; i < n; i += 8) store(to.t + i, t);
  for (std::size_t i = 0; i < n; i += 16) store(to.column + i, column);
  for (std::size_t i = 0; i < n; i += 32) store(to.sensor_id + i, sensor_id);
}

template <std::size_t kProfile>
AVX2 std::size_t write(const OusterColumnView& view, const BeamBlock* blocks, std::size_t beams, const PointRoom& to)
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

const Table kAvx2 = makeTable(std::make_index_sequence<kOusterProfiles.size()>());
}  // namespace scanloom::ouster_kernels
#endif
