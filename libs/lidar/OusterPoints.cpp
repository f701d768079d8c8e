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

/** All channels are written, one behind the other; a channel without a return is overwritten by the next one. */
template <std::size_t kProfile, Return kReturn>
void appendReturn(const OusterColumnView& column, const BeamTable& beams, PointCloud& cloud)
{
  constexpr std::size_t kStride = kOusterProfiles[kProfile].channel_bytes;
  constexpr bool kFirst = kReturn == Return::First;
  constexpr OusterField kReflectivity = kFirst ? OusterField::Reflectivity : OusterField::Reflectivity2;
  constexpr OusterField kSignal = kFirst ? OusterField::Signal : OusterField::Signal2;

  const auto count = static_cast<std::size_t>(beams.size());
  const std::uint8_t* const channels = column.channels.data();
  alignas(32) std::array<std::uint32_t, kMostOusterChannels> ranges;
  alignas(32) std::array<float, kMostOusterChannels> ranges_mm;
  alignas(32) std::array<float, 3 * kMostOusterChannels> positions;
  for (std::size_t i = 0; i < count; ++i)
  {
    ranges[i] = rangeOf<kProfile, kReturn>(channels + i * kStride);
    ranges_mm[i] = static_cast<float>(static_cast<std::int32_t>(ranges[i]));
  }
  beams.project(column.cos_th, column.sin_th, Eigen::Map<const BeamTable::Ranges>(ranges_mm.data(), beams.size()),
                Eigen::Map<BeamTable::Coordinates>(positions.data(), beams.size(), 3));

  std::size_t n = cloud.size();
  cloud.resize(n + count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint8_t* const channel = channels + i * kStride;
    cloud.x[n] = positions[i];
    cloud.y[n] = positions[count + i];
    cloud.z[n] = positions[2 * count + i];
    cloud.intensity[n] = static_cast<float>(static_cast<std::int32_t>(field<kProfile, kReflectivity>(channel)));
    cloud.t[n] = column.t;
    cloud.ring[n] = static_cast<std::uint16_t>(i);
    cloud.column[n] = column.measurement_id;
    cloud.sensor_id[n] = column.sensor_id;
    cloud.range[n] = ranges[i];
    cloud.signal[n] = static_cast<std::uint16_t>(field<kProfile, kSignal>(channel));
    cloud.near_ir[n] = static_cast<std::uint16_t>(field<kProfile, OusterField::NearIr>(channel));
    n += ranges[i] != 0;
  }
  cloud.resize(n);
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
