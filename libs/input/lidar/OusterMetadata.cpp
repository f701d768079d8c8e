#include "input/lidar/OusterMetadata.h"

#include "base/core/Rigid.h"
#include "input/lidar/MetadataKeys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace scanloom
{
namespace
{
// Sections of the nested layout. In the flat layout their keys are at the top level, except for kFlatFormat.
const std::string kSensor = "sensor_info", kBeams = "beam_intrinsics", kLidar = "lidar_intrinsics",
                  kImu = "imu_intrinsics", kConfig = "config_params", kImuFormat = "imu_data_format",
                  kFormat = "lidar_data_format", kFlatFormat = "data_format";

constexpr int kMostChannels = 256;
constexpr std::size_t kLargestDatagram = 65507;

constexpr std::array<std::pair<std::string_view, OusterImuProfile>, 3> kImuProfiles{{
    {"LEGACY", OusterImuProfile::Legacy},
    {"ACCEL32_GYRO32_NMEA", OusterImuProfile::Accel32Gyro32Nmea},
    {"OFF", OusterImuProfile::Off},
}};

constexpr std::array<std::pair<std::string_view, OusterHeader>, 2> kHeaderTypes{{
    {"STANDARD", OusterHeader::Standard},
    {"FUSA", OusterHeader::Fusa},
}};

template <typename Table>
auto valueNamed(const Table& table, const MetadataKeys& keys, const std::string& key, const std::string& name)
{
  std::string known;
  for (const auto& [text, value] : table)
  {
    if (text == name) return value;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", text);
  }
  keys.fail(key, fmt::format("'{}' is unknown; known are {}", name, known));
}

template <typename Table, typename Value>
std::string nameOf(const Table& table, Value value)
{
  return std::string(
      std::find_if(table.begin(), table.end(), [&](const auto& row) { return row.second == value; })->first);
}

/** "1024x10": columns per turn and turns per second. */
std::pair<int, int> parseMode(const MetadataKeys& keys, const std::string& mode)
{
  int columns = 0, rate = 0;
  char times = 0, rest = 0;
  std::istringstream text(mode);
  text >> columns >> times >> rate;
  const bool whole = !text.fail() && !(text >> rest) && times == 'x';
  if (!whole || columns < 1 || columns > 8192 || rate < 1 || rate > 100)
    keys.fail("lidar_mode", fmt::format("must be columns x turns per second such as 1024x10, not '{}'", mode));
  return {columns, rate};
}

/** The section that describes the packets, in either layout. */
const std::string& formatSection(const MetadataKeys& keys)
{
  return keys.integer(kFormat, "columns_per_frame", 1, 8192) ? kFormat : kFlatFormat;
}

void readFormat(const MetadataKeys& keys, OusterMetadata& m)
{
  const std::string& section = formatSection(keys);
  const auto mode = keys.text(kConfig, "lidar_mode");
  if (!mode) keys.fail("lidar_mode", "is missing; expected columns x turns per second such as 1024x10");
  const auto [columns, rate] = parseMode(keys, *mode);

  m.lidar_mode = *mode;
  m.columns_per_frame = keys.integer(section, "columns_per_frame", 1, 8192).value_or(columns);
  m.frame_rate = keys.number(section, "fps", 0, 100).value_or(rate);
  if (m.frame_rate == 0) m.frame_rate = rate;  // the SDK writes 0 if it does not know
  if (m.columns_per_frame != columns)
    keys.fail("columns_per_frame", fmt::format("{} contradicts lidar_mode {}", m.columns_per_frame, *mode));

  m.columns_per_packet = keys.integer(section, "columns_per_packet", 1, 256).value_or(16);
  if (m.columns_per_packet > columns)
    keys.fail("columns_per_packet", fmt::format("{} is more than columns_per_frame {}", m.columns_per_packet, columns));

  const auto window = keys.numbers(section, "column_window", 0, m.columns_per_frame - 1)
                          .value_or(std::vector<double>{0.0, m.columns_per_frame - 1.0});
  if (window.size() != 2)
    keys.fail("column_window", fmt::format("must be [first, last], not {} numbers", window.size()));
  m.first_column = static_cast<int>(window[0]);
  m.last_column = static_cast<int>(window[1]);
  if (m.first_column != window[0] || m.last_column != window[1])
    keys.fail("column_window", "must be two whole numbers");
}

void readProfiles(const MetadataKeys& keys, OusterMetadata& m)
{
  const std::string& section = formatSection(keys);
  m.lidar_profile = keys.text(section, "udp_profile_lidar").value_or("LEGACY");
  if (!findOusterProfile(m.lidar_profile))
  {
    std::string known;
    for (const OusterProfile& p : kOusterProfiles) known += fmt::format("{}{}", known.empty() ? "" : ", ", p.name);
    keys.fail("udp_profile_lidar", fmt::format("'{}' is unknown; known are {}", m.lidar_profile, known));
  }
  m.imu_profile =
      valueNamed(kImuProfiles, keys, "udp_profile_imu", keys.text(section, "udp_profile_imu").value_or("LEGACY"));

  // Before firmware 3.2 there is no header_type: the profile's name tells FUSA.
  const std::string implied = m.lidar_profile.rfind("FUSA_", 0) == 0 ? "FUSA" : "STANDARD";
  m.header_type = valueNamed(kHeaderTypes, keys, "header_type", keys.text(section, "header_type").value_or(implied));
  if (implied == "FUSA") m.header_type = OusterHeader::Fusa;

  const bool needs_count = m.imu_profile == OusterImuProfile::Accel32Gyro32Nmea;
  const auto measurements = keys.integer(kImuFormat, "imu_measurements_per_packet", needs_count ? 1 : 0, 1000);
  if (needs_count && !measurements)
    keys.fail("imu_measurements_per_packet", "is missing; udp_profile_imu ACCEL32_GYRO32_NMEA needs it");
  m.imu_measurements_per_packet = measurements.value_or(0);
  m.imu_packets_per_frame = keys.integer(kImuFormat, "imu_packets_per_frame", 0, 1000).value_or(0);
}

void readBeams(const MetadataKeys& keys, OusterMetadata& m)
{
  const auto angles = [&](const std::string& key, double limit_deg)
  {
    auto list = keys.numbers(kBeams, key, -limit_deg, limit_deg);
    if (!list) keys.fail(key, "is missing; expected a list with one angle in degrees per channel");
    return *std::move(list);
  };
  m.beam_altitude_deg = angles("beam_altitude_angles", 90);
  m.beam_azimuth_deg = angles("beam_azimuth_angles", 360);
  if (m.beam_altitude_deg.empty() || m.beam_altitude_deg.size() > kMostChannels)
    keys.fail("beam_altitude_angles",
              fmt::format("must have 1 to {} numbers, not {}", kMostChannels, m.beam_altitude_deg.size()));

  m.channels = keys.integer(formatSection(keys), "pixels_per_column", 1, kMostChannels)
                   .value_or(static_cast<int>(m.beam_altitude_deg.size()));
  for (const auto& [key, list] :
       {std::pair{"beam_altitude_angles", &m.beam_altitude_deg}, std::pair{"beam_azimuth_angles", &m.beam_azimuth_deg}})
    if (static_cast<int>(list->size()) != m.channels)
      keys.fail(key, fmt::format("must have one number per channel ({}), not {}", m.channels, list->size()));
}

/** Default distance of the beams' origin from the axis, mm; without a product line that of the first generation. */
double defaultBeamOrigin(const std::string& product_line)
{
  constexpr std::array<std::pair<std::string_view, double>, 3> kOrigins{
      {{"OS-0-", 27.67}, {"OS-1-", 15.806}, {"OS-2-", 13.762}}};
  for (const auto& [prefix, origin] : kOrigins)
    if (product_line.rfind(prefix, 0) == 0) return origin;
  return 12.163;
}

Eigen::Matrix4d translation(double x, double y, double z)
{
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.col(3).head<3>() << x, y, z;
  return matrix;
}

/** 16 numbers, row by row, of a rigid transform; translations in mm, within 10 m. */
std::optional<Eigen::Matrix4d> readTransform(const MetadataKeys& keys, const std::string& section,
                                             const std::string& key)
{
  constexpr double kTenMetresInMm = 10000;
  const auto elements = keys.numbers(section, key, -kTenMetresInMm, kTenMetresInMm);
  if (!elements) return std::nullopt;
  if (elements->size() != 16)
    keys.fail(key, fmt::format("must have 16 numbers (4x4, row by row), not {}", elements->size()));
  const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(elements->data());
  try
  {
    Rigid::fromMatrix(matrix);
  }
  catch (const std::invalid_argument& e)
  {
    keys.fail(key, fmt::format("must be a rigid transform ({})", e.what()));
  }
  return matrix;
}

void readTransforms(const MetadataKeys& keys, OusterMetadata& m)
{
  const double origin =
      keys.number(kBeams, "lidar_origin_to_beam_origin_mm", -1000, 1000).value_or(defaultBeamOrigin(m.product_line));
  m.beam_to_lidar_mm = readTransform(keys, kBeams, "beam_to_lidar_transform").value_or(translation(origin, 0, 0));

  Eigen::Matrix4d half_turn = translation(0, 0, 36.18);
  half_turn(0, 0) = half_turn(1, 1) = -1;
  m.lidar_to_sensor_mm = readTransform(keys, kLidar, "lidar_to_sensor_transform").value_or(half_turn);
  m.imu_to_sensor_mm =
      readTransform(keys, kImu, "imu_to_sensor_transform").value_or(translation(6.253, -11.775, 7.645));
}

void readIdentity(const MetadataKeys& keys, OusterMetadata& m)
{
  m.product_line = keys.text(kSensor, "prod_line").value_or("");
  m.serial = keys.text(kSensor, "prod_sn").value_or("");
  m.firmware = keys.text(kSensor, "build_rev").value_or("");
  m.timestamp_mode = keys.text(kConfig, "timestamp_mode").value_or("");
  if (const auto id = keys.integer(kSensor, "initialization_id", 0, 0xFFFFFF))
    m.init_id = static_cast<std::uint32_t>(*id);
  m.lidar_port = static_cast<std::uint16_t>(keys.integer(kConfig, "udp_port_lidar", 0, 65535).value_or(0));
  m.imu_port = static_cast<std::uint16_t>(keys.integer(kConfig, "udp_port_imu", 0, 65535).value_or(0));
}
}  // namespace

bool looksLikeOuster(const std::string& text)
{
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos || text[first] != '{') return false;
  constexpr std::array kKeys{"sensor_info", "beam_intrinsics", "beam_altitude_angles", "beam_azimuth_angles",
                             "lidar_mode",  "prod_line",       "data_format"};
  return std::any_of(kKeys.begin(), kKeys.end(),
                     [&](const char* key) { return text.find(fmt::format("\"{}\"", key)) != std::string::npos; });
}

OusterMetadata parseOusterMetadata(const std::string& text, const std::string& name)
{
  const MetadataKeys keys(text, name);
  OusterMetadata m;
  readIdentity(keys, m);
  readFormat(keys, m);
  readProfiles(keys, m);
  readBeams(keys, m);
  readTransforms(keys, m);
  if (layoutOf(m).lidarPacketBytes() > kLargestDatagram)
    keys.fail("columns_per_packet",
              fmt::format("{} columns of {} channels make packets of {} bytes, more than UDP can carry",
                          m.columns_per_packet, m.channels, layoutOf(m).lidarPacketBytes()));
  return m;
}

OusterMetadata loadOusterMetadata(const std::string& path) { return parseOusterMetadata(readMetadataText(path), path); }

std::string toJson(const OusterMetadata& m)
{
  const auto rows = [](const Eigen::Matrix4d& matrix)
  {
    std::vector<double> list;
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) list.push_back(matrix(r, c));
    return list;
  };
  nlohmann::json json;
  json[kSensor] = {
      {"prod_line", m.product_line}, {"prod_sn", m.serial}, {"build_rev", m.firmware}, {"status", "RUNNING"}};
  if (m.init_id) json[kSensor]["initialization_id"] = *m.init_id;
  json[kConfig] = {{"lidar_mode", m.lidar_mode}, {"udp_port_lidar", m.lidar_port}, {"udp_port_imu", m.imu_port}};
  if (!m.timestamp_mode.empty()) json[kConfig]["timestamp_mode"] = m.timestamp_mode;
  json[kFormat] = {{"pixels_per_column", m.channels},
                   {"columns_per_packet", m.columns_per_packet},
                   {"columns_per_frame", m.columns_per_frame},
                   {"column_window", {m.first_column, m.last_column}},
                   {"fps", m.frame_rate},
                   {"udp_profile_lidar", m.lidar_profile},
                   {"udp_profile_imu", nameOf(kImuProfiles, m.imu_profile)},
                   {"header_type", nameOf(kHeaderTypes, m.header_type)}};
  json[kImuFormat] = {{"imu_measurements_per_packet", m.imu_measurements_per_packet},
                      {"imu_packets_per_frame", m.imu_packets_per_frame}};
  json[kBeams] = {{"beam_altitude_angles", m.beam_altitude_deg},
                  {"beam_azimuth_angles", m.beam_azimuth_deg},
                  {"beam_to_lidar_transform", rows(m.beam_to_lidar_mm)},
                  {"lidar_origin_to_beam_origin_mm", m.beam_to_lidar_mm(0, 3)}};
  json[kLidar] = {{"lidar_to_sensor_transform", rows(m.lidar_to_sensor_mm)}};
  json[kImu] = {{"imu_to_sensor_transform", rows(m.imu_to_sensor_mm)}};
  return json.dump(2);
}
}  // namespace scanloom
