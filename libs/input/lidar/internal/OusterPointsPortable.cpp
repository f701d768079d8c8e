/** Sixteen channels at a time in plain C++, in loops that compilers can vectorise. */
#include "input/lidar/internal/OusterKernels.h"

#include <algorithm>

namespace scanloom::ouster_kernels
{
namespace
{
constexpr std::size_t kLanes = BeamBlock::kBeams;

template <std::size_t kProfile, OusterField kField>
std::uint32_t field(const std::uint8_t* channel)
{
  using To = Move<kProfile, kField>;
  if constexpr (!To::kPresent) return 0;
  std::uint32_t word;
  std::memcpy(&word, channel + 4 * To::kWord, 4);
  return (To::kShift < 0 ? word >> -To::kShift : word << To::kShift) & To::kMask;
}

/** The range of a return, 0 for none. A second return at the range of the first is left out. */
template <std::size_t kProfile, Return kReturn>
std::uint32_t rangeOf(const std::uint8_t* channel)
{
  const std::uint32_t first = field<kProfile, OusterField::Range>(channel);
  if constexpr (kReturn == Return::First) return first;
  const std::uint32_t second = field<kProfile, OusterField::Range2>(channel);
  return second == first ? 0 : second;
}

/** The fields of sixteen channels, whether or not they have a return. */
struct Readings
{
  alignas(64) float x[kLanes], y[kLanes], z[kLanes];
  std::uint32_t range[kLanes];
  std::uint16_t signal[kLanes], near_ir[kLanes];
  std::uint8_t intensity[kLanes], ring[kLanes];
};

template <std::size_t kProfile, Return kReturn>
void read(const std::uint8_t* channels, std::size_t ring, Readings& readings)
{
  constexpr std::size_t kBytes = kOusterProfiles[kProfile].channel_bytes;
  for (std::size_t i = 0; i < kLanes; ++i)
  {
    const std::uint8_t* channel = channels + i * kBytes;
    readings.range[i] = rangeOf<kProfile, kReturn>(channel);
    readings.intensity[i] = static_cast<std::uint8_t>(field<kProfile, Fields<kReturn>::kReflectivity>(channel));
    readings.signal[i] = static_cast<std::uint16_t>(field<kProfile, Fields<kReturn>::kSignal>(channel));
    readings.near_ir[i] = static_cast<std::uint16_t>(field<kProfile, OusterField::NearIr>(channel));
    readings.ring[i] = static_cast<std::uint8_t>(ring + i);
  }
}

/** Angle of the column and origin of its rays. */
struct Column
{
  float cos_th, sin_th, range_offset, origin[3];
};

Column columnOf(const OusterColumnView& view, const BeamBlock& any)
{
  Column column;  // not zeroed first: gcc makes that a slow "rep stos"
  column.cos_th = view.cos_th;
  column.sin_th = view.sin_th;
  column.range_offset = any.range_offset[0];
  for (int k = 0; k < 3; ++k) column.origin[k] = view.cos_th * any.d[k][0] + view.sin_th * any.e[k][0] + any.f[k][0];
  return column;
}

/** Without __restrict compilers must assume that writing a coordinate changes the table. */
void project(const Column& column, const BeamBlock& beams, int k, const float* __restrict along, float* __restrict to)
{
  const float* __restrict a = beams.a[k];
  const float* __restrict b = beams.b[k];
  const float* __restrict c = beams.c[k];
  const float cos_th = column.cos_th, sin_th = column.sin_th, origin = column.origin[k];
  for (std::size_t i = 0; i < kLanes; ++i) to[i] = along[i] * (cos_th * a[i] + sin_th * b[i] + c[i]) + origin;
}

void project(const Column& column, const BeamBlock& beams, Readings& readings)
{
  alignas(64) float along[kLanes];
  for (std::size_t i = 0; i < kLanes; ++i)
    along[i] = static_cast<float>(static_cast<std::int32_t>(readings.range[i])) - column.range_offset;
  project(column, beams, 0, along, readings.x);
  project(column, beams, 1, along, readings.y);
  project(column, beams, 2, along, readings.z);
}

template <std::size_t kCount>
void copy(const Readings& from, std::size_t i, const PointRoom& to, std::size_t n)
{
  std::memcpy(to.x + n, from.x + i, kCount * sizeof *to.x);
  std::memcpy(to.y + n, from.y + i, kCount * sizeof *to.y);
  std::memcpy(to.z + n, from.z + i, kCount * sizeof *to.z);
  std::memcpy(to.intensity + n, from.intensity + i, kCount * sizeof *to.intensity);
  std::memcpy(to.range + n, from.range + i, kCount * sizeof *to.range);
  std::memcpy(to.ring + n, from.ring + i, kCount * sizeof *to.ring);
  std::memcpy(to.signal + n, from.signal + i, kCount * sizeof *to.signal);
  std::memcpy(to.near_ir + n, from.near_ir + i, kCount * sizeof *to.near_ir);
}

/** Copies the returns. Four neighbours with returns are one copy; otherwise one without is overwritten by the next. */
std::size_t squeeze(const Readings& readings, const PointRoom& to, std::size_t n)
{
  for (std::size_t i = 0; i < kLanes; i += 4)
  {
    const std::uint32_t* range = readings.range + i;
    if (range[0] && range[1] && range[2] && range[3])
    {
      copy<4>(readings, i, to, n);
      n += 4;
      continue;
    }
    for (std::size_t lane = 0; lane < 4; ++lane)
    {
      copy<1>(readings, i + lane, to, n);
      n += range[lane] != 0;
    }
  }
  return n;
}

template <std::size_t kProfile, Return kReturn>
std::size_t writeReturn(const OusterColumnView& view, const BeamBlock* blocks, std::size_t beams, const PointRoom& to,
                        std::size_t n)
{
  constexpr std::size_t kBytes = kOusterProfiles[kProfile].channel_bytes;
  fetchNarrowFields(to, n);
  const Column column = columnOf(view, *blocks);
  const std::uint8_t* channels = view.channels;
  Readings readings;
  for (std::size_t ring = 0; ring < beams; ring += kLanes, channels += kLanes * kBytes, ++blocks)
  {
    std::uint8_t last[kLanes * kBytes] = {};  // missing channels have no return
    const bool whole = ring + kLanes <= beams;
    if (!whole) std::memcpy(last, channels, (beams - ring) * kBytes);
    read<kProfile, kReturn>(whole ? channels : last, ring, readings);
    project(column, *blocks, readings);
    fetchWideFields(to, n);
    n = squeeze(readings, to, n);
  }
  return n;
}

template <std::size_t kProfile>
std::size_t write(const OusterColumnView& view, const BeamBlock* blocks, std::size_t beams, const PointRoom& to)
{
  std::size_t n = writeReturn<kProfile, Return::First>(view, blocks, beams, to, 0);
  if constexpr (kOusterProfiles[kProfile].returns() == 2)
    n = writeReturn<kProfile, Return::Second>(view, blocks, beams, to, n);
  std::fill_n(to.t, n, view.t);
  std::fill_n(to.column, n, view.measurement_id);
  std::fill_n(to.sensor_id, n, view.sensor_id);
  return n;
}

template <std::size_t... kRows>
constexpr Table makeTable(std::index_sequence<kRows...>)
{
  return {&write<kRows>...};
}
}  // namespace

const Table kPortable = makeTable(std::make_index_sequence<kOusterProfiles.size()>());
}  // namespace scanloom::ouster_kernels
