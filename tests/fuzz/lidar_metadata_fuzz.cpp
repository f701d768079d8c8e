/**
 * Any text as a metadata file of any family: a decoder that works, or std::invalid_argument. The first byte chooses
 * between the rest as the text, and the rest as changes to a sound file, so that more is reached than the JSON parser.
 * fuzz options: -max_len=1024
 */
#include <nlohmann/json.hpp>

#include <array>
#include <stdexcept>
#include <string>

#include "../input/lidar/simpleMetadata.h"
#include "input/lidar/LidarModels.h"
#include "input/lidar/OusterDecoder.h"
#include "require.h"

using namespace scanloom;

namespace
{
using Json = nlohmann::json;

struct SoundFile
{
  Json json;
  std::vector<std::string> places;  // JSON pointers to its values
};

SoundFile withPlaces(const std::string& text)
{
  SoundFile file{Json::parse(text), {}};
  const Json flat = file.json.flatten();
  for (auto value = flat.begin(); value != flat.end(); ++value)
  {
    file.places.push_back(value.key());
    const std::string parent = value.key().substr(0, value.key().rfind('/'));
    if (!parent.empty() && file.places.front() != parent) file.places.push_back(parent);  // whole lists and sections
  }
  return file;
}

std::vector<SoundFile> soundFiles()
{
  OusterMetadata imu = simpleMetadata("RNG19_RFL8_SIG16_NIR16_DUAL", 2, 4);
  imu.imu_profile = OusterImuProfile::Accel32Gyro32Nmea;
  imu.imu_measurements_per_packet = 8;
  return {
      withPlaces(toJson(simpleMetadata("RNG15_RFL8_NIR8", 2, 4))),
      withPlaces(toJson(imu)),
      withPlaces(R"({"prod_line": "OS-1-2", "prod_sn": "991900000000", "lidar_mode": "512x10",
                     "beam_altitude_angles": [10, -10], "beam_azimuth_angles": [1, -1],
                     "lidar_origin_to_beam_origin_mm": 15.8, "lidar_to_sensor_transform": [-1, 0, 0, 0, 0, -1, 0, 0,
                     0, 0, 1, 36.18, 0, 0, 0, 1], "imu_to_sensor_transform": [1, 0, 0, 6, 0, 1, 0, -11, 0, 0, 1, 7, 0,
                     0, 0, 1], "data_format": {"pixels_per_column": 2, "columns_per_packet": 16, "columns_per_frame":
                     512, "column_window": [0, 511], "pixel_shift_by_row": [0, 0]}})"),
      withPlaces(R"({"lidar": "velodyne", "model": "VLP-16", "product_id": 33, "serial": "x", "rpm": 600, "port": 2368,
                     "field_of_view_deg": [270, 90],
                     "vertical_angles_deg": [-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15],
                     "azimuth_offsets_deg": [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
                     "vertical_offsets_mm": [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]})"),
      withPlaces(R"({"lidar": "hesai", "model": "XT16", "serial": "x", "rpm": 600, "returns": 2, "port": 2368,
                     "field_of_view_deg": [270, 90],
                     "vertical_angles_deg": [15, 13, 11, 9, 7, 5, 3, 1, -1, -3, -5, -7, -9, -11, -13, -15],
                     "azimuth_offsets_deg": [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]})"),
      withPlaces(R"({"lidar": "robosense", "model": "Helios-16P", "serial": "x", "rpm": 600, "returns": 2, "port": 6699,
                     "field_of_view_deg": [270, 90],
                     "vertical_angles_deg": [15, 13, 11, 9, 7, 5, 4, 3, 1, 0, -1, -3, -4, -5, -7, -8],
                     "azimuth_offsets_deg": [-4, 4, -4, 4, -4, 4, -4, 4, -4, 4, -4, 4, -4, 4, -4, 4]})"),
  };
}

Json value(std::uint8_t kind, std::uint8_t size)
{
  constexpr std::array<const char*, 10> kTexts{
      "",    "LEGACY", "FUSA", "1024x10", "2048x1", "512x100", "RNG15_RFL8_NIR8", "FUSA_RNG15_RFL8_NIR8_DUAL",
      "OFF", "\xff"};
  switch (kind % 12)
  {
    case 0:
      return nullptr;
    case 1:
      return size;
    case 2:
      return -static_cast<int>(size);
    case 3:
      return 1e308 * size;
    case 4:
      return std::uint64_t{1} << size % 64;
    case 5:
      return size / 7.0;
    case 6:
      return kTexts[size % kTexts.size()];
    case 7:
      return std::string(size, 'x');
    case 8:
      return std::vector<int>(size, 1);
    case 9:
      return Json::array({size, Json::array({1, 2})});
    case 10:
      return Json::object({{"lidar", "velodyne"}, {"columns_per_frame", size * 32}});
    default:
      return size % 2 == 0;
  }
}

/** `changes`: place, kind and size of the new value, three bytes each. */
std::string changed(const SoundFile& file, Bytes changes)
{
  Json json = file.json;
  for (std::size_t i = 0; i + 3 <= changes.size() && i < 24; i += 3)
  {
    const Json::json_pointer place(file.places[changes[i] % file.places.size()]);
    mayThrow<Json::exception>(
        [&] { json[place] = value(changes[i + 1], changes[i + 2]); });  // an earlier change left no such place
  }
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

void decode(const std::string& text)
{
  if (!looksLikeOuster(text) || text.find("\"lidar\"") != std::string::npos)
  {
    const auto decoder = makeDecoder(text, "fuzz.json", Rigid::identity());
    require(decoder->description().blockPeriod() > Duration{0} && decoder->description().columns_per_frame > 0);
    return;
  }
  const OusterMetadata metadata = parseOusterMetadata(text, "fuzz.json");
  if (text.size() % 8 != 0) return;  // what follows takes most of the time
  const OusterDecoder decoder(metadata, Rigid::identity());
  require(toJson(decoder.metadata()) == toJson(metadata));
  require(decoder.description().blockPeriod() > Duration{0});
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const std::vector<SoundFile> files = soundFiles();
  if (size == 0) return 0;
  const Bytes rest(data + 1, size - 1);
  const bool is_text = data[0] >= files.size();
  mayThrow<std::invalid_argument>(
      [&] { decode(is_text ? std::string(rest.begin(), rest.end()) : changed(files[data[0]], rest)); });
  return 0;
}
