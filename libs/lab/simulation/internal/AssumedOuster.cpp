#include "lab/simulation/internal/AssumedOuster.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

namespace scanloom
{
namespace
{
// Ranges: data sheets of OS0, OS1 and OS2, rev. 7. Angles: rounded from the maker's example metadata. Lengths: nominal
// values in the drawings of the hardware manual.
constexpr std::array<OusterFamily, 3> kFamilies{{
    {"OS0", 0.3, 35, 43.9, 1.6, 2.8, 8.4, 0.31, 27.67, 36.18},
    {"OS1", 0.5, 90, 21.6, 0, 1.42, 4.25, 0, 15.806, 36.18},
    {"OS2", 1.0, 200, 11.0, 0, 0.69, 2.07, 0, 13.762, 78.296},
}};

/** The numbers before and after a separator. */
struct Pair
{
  int first = 0, second = 0;
};

std::optional<Pair> parsePair(const std::string& text, char sign)
{
  Pair pair;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, pair.first);
  if (first.ec != std::errc{} || first.ptr == end || *first.ptr != sign) return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, pair.second);
  if (second.ec != std::errc{} || second.ptr != end) return std::nullopt;
  return pair;
}

/** "OS-0-128" and "OS0-128" both give "0-128". */
std::string withoutOs(const std::string& model)
{
  const std::size_t begin = model.rfind("OS-", 0) == 0 ? 3 : model.rfind("OS", 0) == 0 ? 2 : model.size();
  return model.substr(begin);
}

std::invalid_argument unknownModel(const std::string& model)
{
  return std::invalid_argument(
      fmt::format("model = '{}': must be OS0, OS1 or OS2 with a number of beams between 8 and "
                  "128, OS0-32 for instance",
                  model));
}
}  // namespace

const OusterFamily& ousterFamily(const std::string& model)
{
  const std::string family = "OS" + withoutOs(model).substr(0, 1);
  const auto found =
      std::find_if(kFamilies.begin(), kFamilies.end(), [&](const auto& row) { return row.name == family; });
  if (found == kFamilies.end()) throw unknownModel(model);
  return *found;
}

void setMode(OusterMetadata& metadata, const std::string& text)
{
  const auto mode = parsePair(text, 'x');
  const bool known_columns = mode && (mode->first == 512 || mode->first == 1024 || mode->first == 2048);
  const bool known = known_columns && (mode->second == 10 || (mode->second == 20 && mode->first < 2048));
  if (!known)
    throw std::invalid_argument(fmt::format("mode = '{}': must be 512x10, 1024x10, 2048x10, 512x20 or 1024x20", text));
  metadata.lidar_mode = text;
  metadata.columns_per_frame = mode->first;
  metadata.first_column = 0;
  metadata.last_column = mode->first - 1;
  metadata.frame_rate = mode->second;
}

void setProfile(OusterMetadata& metadata, const std::string& name)
{
  if (!findOusterProfile(name))
    throw std::invalid_argument(
        fmt::format("profile = '{}': must be a UDP profile of Ouster, for example RNG15_RFL8_NIR8 or "
                    "RNG19_RFL8_SIG16_NIR16",
                    name));
  metadata.lidar_profile = name;
  const bool is_fusa = name.rfind("FUSA_", 0) == 0;
  metadata.header_type = is_fusa ? OusterHeader::Fusa : OusterHeader::Standard;
}

OusterMetadata assumedOuster(const OusterUnit& unit)
{
  const OusterFamily& family = ousterFamily(unit.model);
  const auto beams = parsePair(withoutOs(unit.model), '-');
  if (!beams || beams->second < 8 || beams->second > 128) throw unknownModel(unit.model);

  OusterMetadata ouster;
  ouster.product_line = fmt::format("OS-{}-{}", beams->first, beams->second);
  ouster.serial = unit.serial;
  ouster.firmware = "v3.0.1";
  ouster.init_id = unit.init_id;
  ouster.timestamp_mode = "TIME_FROM_PTP_1588";
  ouster.channels = beams->second;
  ouster.lidar_port = unit.lidar_port;
  ouster.imu_port = static_cast<std::uint16_t>(unit.lidar_port + 1);
  setMode(ouster, unit.mode);
  setProfile(ouster, unit.profile);
  const std::array columns{family.outer_azimuth_deg, family.inner_azimuth_deg, -family.inner_azimuth_deg,
                           -family.outer_azimuth_deg};
  for (int beam = 0; beam < ouster.channels; ++beam)
  {
    const double u = 1 - (2 * beam + 1.0) / ouster.channels;
    const std::size_t column = ouster.channels < 64 ? 0 : static_cast<std::size_t>(beam) % columns.size();
    ouster.beam_altitude_deg.push_back(family.edge_deg * u + family.pincushion_deg * u * u * u);
    ouster.beam_azimuth_deg.push_back(columns[column] * (1 + family.azimuth_bow * u * u));
  }
  ouster.beam_to_lidar_mm(0, 3) = family.beam_radius_mm;
  ouster.lidar_to_sensor_mm.diagonal() << -1, -1, 1, 1;
  ouster.lidar_to_sensor_mm(2, 3) = family.lidar_height_mm;
  ouster.imu_to_sensor_mm.topRightCorner<3, 1>() << 6.253, -11.775, 7.645;
  return ouster;
}
}  // namespace scanloom
