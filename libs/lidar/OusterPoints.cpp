#include "lidar/OusterPoints.h"

#include <array>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
/** One field of a channel whose bytes are known to be there; which bytes is settled at compile time. */
template <std::size_t kProfile, OusterField kField>
std::uint32_t field(const std::uint8_t* channel)
{
  constexpr OusterProfile kRow = kOusterProfiles[kProfile];
  constexpr BitField f = kRow[kField];
  if constexpr (!f.present()) return 0;

  // Three bytes are read as four where the channel has them.
  constexpr std::size_t kRead = f.byteCount() == 3 && f.firstByte() + 4 <= kRow.channel_bytes ? 4 : f.byteCount();
  std::uint32_t word = 0;
  std::memcpy(&word, channel + f.firstByte(), kRead);
  return ((word >> (f.first % 8)) & f.mask()) << f.shift;
}

enum class Return
{
  First,
  Second,
};

/** The range that becomes a point; 0 for none. A second return where the first one is, is the first one. */
template <std::size_t kProfile, Return kReturn>
std::uint32_t rangeOf(const std::uint8_t* channel)
{
  const std::uint32_t first = field<kProfile, OusterField::Range>(channel);
  if constexpr (kReturn == Return::First) return first;
  const std::uint32_t second = field<kProfile, OusterField::Range2>(channel);
  return second == first ? 0 : second;
}

template <typename T>
using PerChannel = std::array<T, kMostOusterChannels>;

/** The fields of a column's returns, one behind the other: on the stack, so that the loop over channels has no bounds.
 */
struct Returns
{
  alignas(32) PerChannel<float> x, y, z, intensity;
  PerChannel<std::uint32_t> range;
  PerChannel<std::uint16_t> ring, signal, near_ir;
  std::size_t count = 0;
};

void append(const Returns& returns, const OusterColumnView& column, PointCloud& cloud)
{
  const auto copy = [n = returns.count](const auto& from, auto& to)
  { to.insert(to.end(), from.data(), from.data() + n); };
  const auto fill = [n = returns.count](auto value, auto& to) { to.insert(to.end(), n, value); };
  copy(returns.x, cloud.x);
  copy(returns.y, cloud.y);
  copy(returns.z, cloud.z);
  copy(returns.intensity, cloud.intensity);
  fill(column.t, cloud.t);
  copy(returns.ring, cloud.ring);
  fill(column.measurement_id, cloud.column);
  fill(column.sensor_id, cloud.sensor_id);
  copy(returns.range, cloud.range);
  copy(returns.signal, cloud.signal);
  copy(returns.near_ir, cloud.near_ir);
}

/** Every channel is written; one without a return is overwritten by the next: no branch that the sky would mispredict.
 */
template <std::size_t kProfile, Return kReturn>
void appendReturn(const OusterColumnView& column, const BeamTable& beams, PointCloud& cloud)
{
  constexpr std::size_t kStride = kOusterProfiles[kProfile].channel_bytes;
  constexpr bool kFirst = kReturn == Return::First;
  constexpr OusterField kReflectivity = kFirst ? OusterField::Reflectivity : OusterField::Reflectivity2;
  constexpr OusterField kSignal = kFirst ? OusterField::Signal : OusterField::Signal2;

  const auto channels = static_cast<std::size_t>(beams.size());
  alignas(32) PerChannel<float> ranges_mm;
  alignas(32) std::array<float, 3 * kMostOusterChannels> positions;
  for (std::size_t i = 0; i < channels; ++i)
    ranges_mm[i] =
        static_cast<float>(static_cast<std::int32_t>(rangeOf<kProfile, kReturn>(column.channels.data() + i * kStride)));
  beams.project(column.cos_th, column.sin_th, Eigen::Map<const BeamTable::Ranges>(ranges_mm.data(), beams.size()),
                Eigen::Map<BeamTable::Coordinates>(positions.data(), beams.size(), 3));

  Returns returns;
  std::size_t n = 0;
  const std::uint8_t* channel = column.channels.data();
  for (std::size_t i = 0; i < channels; ++i, channel += kStride)
  {
    const std::uint32_t range = rangeOf<kProfile, kReturn>(channel);
    returns.x[n] = positions[i];
    returns.y[n] = positions[channels + i];
    returns.z[n] = positions[2 * channels + i];
    returns.intensity[n] = static_cast<float>(static_cast<std::int32_t>(field<kProfile, kReflectivity>(channel)));
    returns.ring[n] = static_cast<std::uint16_t>(i);
    returns.range[n] = range;
    returns.signal[n] = static_cast<std::uint16_t>(field<kProfile, kSignal>(channel));
    returns.near_ir[n] = static_cast<std::uint16_t>(field<kProfile, OusterField::NearIr>(channel));
    n += range != 0;
  }
  returns.count = n;
  append(returns, column, cloud);
}

template <std::size_t kProfile>
void appendColumn(const OusterColumnView& column, const BeamTable& beams, PointCloud& cloud)
{
  const auto count = static_cast<std::size_t>(beams.size());
  if (count > kMostOusterChannels || column.channels.size() != count * kOusterProfiles[kProfile].channel_bytes)
    throw std::out_of_range("appendColumn: the column does not have the table's channels");
  appendReturn<kProfile, Return::First>(column, beams, cloud);
  if constexpr (kOusterProfiles[kProfile].returns() == 2) appendReturn<kProfile, Return::Second>(column, beams, cloud);
}

template <std::size_t... kRows>
constexpr auto makeAppenders(std::index_sequence<kRows...>)
{
  return std::array<AppendOusterColumn, sizeof...(kRows)>{&appendColumn<kRows>...};
}
constexpr auto kAppenders = makeAppenders(std::make_index_sequence<kOusterProfiles.size()>());
}  // namespace

AppendOusterColumn appenderFor(const OusterProfile& profile)
{
  for (std::size_t i = 0; i < kOusterProfiles.size(); ++i)
    if (kOusterProfiles[i].name == profile.name) return kAppenders[i];
  throw std::invalid_argument("appenderFor: not a row of kOusterProfiles");
}
}  // namespace scanloom
