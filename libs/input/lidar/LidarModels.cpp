#include "input/lidar/LidarModels.h"

#include "input/lidar/BuiltInModels.h"
#include "input/lidar/CloudPacket.h"
#include "input/lidar/MetadataKeys.h"
#include "input/lidar/OusterDecoder.h"
#include "input/lidar/internal/Hesai.h"
#include "input/lidar/internal/Robosense.h"
#include "input/lidar/internal/Velodyne.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace scanloom
{
namespace
{
struct LidarFamily
{
  std::string_view name;  // the value of "lidar" in its metadata; empty: its maker's own files, which have no such key
  const char* described;  // what its metadata file is, for the error that lists the families
  std::unique_ptr<PacketDecoder> (*make)(const std::string& metadata_text, const std::string& file_name,
                                         const Rigid& body_T_sensor);
  std::vector<StampedModel> (*models)();  // the rows of its table
};

template <auto kParse, auto kMake>
std::unique_ptr<PacketDecoder> make(const std::string& text, const std::string& name, const Rigid& body_T_sensor)
{
  return kMake(kParse(text, name), body_T_sensor);
}

std::unique_ptr<PacketDecoder> makeOuster(const OusterMetadata& metadata, const Rigid& body_T_sensor)
{
  return std::make_unique<OusterDecoder>(metadata, body_T_sensor);
}

template <const auto& kModels>
std::vector<StampedModel> rowsOf()
{
  return {kModels.begin(), kModels.end()};
}

std::vector<StampedModel> noRows() { return {}; }

const std::array<LidarFamily, 5> kFamilies{{
    {"velodyne", R"(a JSON file that begins with "lidar": "velodyne" (params/lidars/))",
     &make<parseVelodyneMetadata, makeVelodyne>, &rowsOf<kVelodyneModels>},
    {"hesai", R"(a JSON file that begins with "lidar": "hesai" (params/lidars/))", &make<parseHesaiMetadata, makeHesai>,
     &rowsOf<kHesaiModels>},
    {"robosense", R"(a JSON file that begins with "lidar": "robosense" (params/lidars/))",
     &make<parseRobosenseMetadata, makeRobosense>, &rowsOf<kRobosenseModels>},
    {"cloud", R"(the text {"lidar": "cloud"} for clouds of a bag)", &make<parseCloudMetadata, makeCloudDecoder>,
     &noRows},
    {"", "the JSON text of an Ouster sensor's metadata", &make<parseOusterMetadata, makeOuster>, &noRows},
}};

bool recognises(const LidarFamily& family, const std::string& text)
{
  return family.name.empty() ? looksLikeOuster(text) : namesLidar(text, std::string(family.name));
}

using Packets = std::vector<std::vector<std::uint8_t>>;

/** Perhaps of another model or, as an early VLP-16 is known by its rotor, of another rotor. */
bool hasItsForm(const PacketDecoder& decoder, Bytes packet)
{
  const PacketKind kind = decoder.kind(packet);
  return kind == PacketKind::Lidar || kind == PacketKind::Foreign;
}

/** By the columns and stamps of the packets' first and last blocks; nothing if they turned too little to tell. */
std::optional<double> turnsPerSecond(const PacketDecoder& decoder, const Packets& packets)
{
  constexpr std::int64_t kLeastColumns = 100;
  const LidarDescription& lidar = decoder.description();
  std::int64_t columns = 0;
  Duration time{0};
  std::vector<MeasurementBlock> blocks;
  for (const auto& packet : packets)
  {
    if (!hasItsForm(decoder, packet)) continue;
    decoder.readBlocks(packet, blocks);
    const int step = blocks.back().measurement_id - blocks.front().measurement_id;
    const Duration passed = blocks.back().stamp - blocks.front().stamp;
    if (passed <= Duration{0}) continue;  // the hour is over
    columns += step < 0 ? step + lidar.columns_per_frame : step;
    time += passed;
  }
  if (columns < kLeastColumns) return std::nullopt;
  return static_cast<double>(columns) / (lidar.columns_per_frame * seconds(time));
}

/** The name, with the rotor's rate if it is not the model's; nothing if the first packet is not the model's. */
std::optional<std::string> nameWithRotor(const std::string& name, const Packets& packets)
try
{
  constexpr int kStep = 60, kSlowest = 300, kFastest = 1200;  // in rpm, as makers let it be set
  auto decoder = makeDecoder(*builtInMetadata(name), name, Rigid::identity());
  if (!hasItsForm(*decoder, packets.front())) return std::nullopt;
  const double nominal = decoder->description().frame_rate;
  const double measured = turnsPerSecond(*decoder, packets).value_or(nominal);
  const int rpm = kStep * static_cast<int>(std::lround(measured * 60 / kStep));
  const bool other = std::abs(rpm - 60 * nominal) > 1 && rpm >= kSlowest && rpm <= kFastest;
  const std::string full_name = other ? fmt::format("{} {} rpm", name, rpm) : name;
  if (other) decoder = makeDecoder(*builtInMetadata(full_name), full_name, Rigid::identity());
  return decoder->kind(packets.front()) == PacketKind::Lidar ? std::optional(full_name) : std::nullopt;
}
catch (const std::invalid_argument&)  // two returns of this model are not read
{
  return std::nullopt;
}
}  // namespace

std::unique_ptr<PacketDecoder> makeDecoder(const std::string& metadata_file, const Rigid& body_T_sensor)
{
  return makeDecoder(metadataText(metadata_file), metadata_file, body_T_sensor);
}

std::unique_ptr<PacketDecoder> makeDecoder(const std::string& metadata_text, const std::string& name,
                                           const Rigid& body_T_sensor)
{
  std::string expected;
  for (const LidarFamily& family : kFamilies)
  {
    if (recognises(family, metadata_text)) return family.make(metadata_text, name, body_T_sensor);
    expected += fmt::format("{}{}", expected.empty() ? "" : ", or ", family.described);
  }
  throw std::invalid_argument(fmt::format("{}: belongs to no known lidar; expected {}", name, expected));
}

bool isLidarMetadata(const std::string& text)
{
  return std::any_of(kFamilies.begin(), kFamilies.end(),
                     [&](const LidarFamily& family) { return recognises(family, text); });
}

std::vector<std::string> modelsThatSend(const std::vector<std::vector<std::uint8_t>>& packets)
{
  std::vector<std::string> names;
  if (packets.empty()) return names;
  for (const BuiltInModel& model : builtInModels())
    for (const char* returns : {"", " dual"})
      if (const auto name = nameWithRotor(std::string(model.name) + returns, packets)) names.push_back(*name);
  return names;
}

std::vector<std::string> metadataToComplete(Bytes packet)
{
  std::vector<std::string> texts;
  for (const LidarFamily& family : kFamilies)
    for (const StampedModel& model : family.models())
      for (const int returns : {1, 2})
      {
        if (builtInMetadata(std::string(model.name))) continue;
        const std::string text =
            fmt::format(R"("lidar": "{}", "model": "{}", "returns": {})", family.name, model.name, returns);
        const std::vector<double> level(static_cast<std::size_t>(model.channels), 0.0);
        const auto decoder = family.make(
            fmt::format(R"({{{}, "vertical_angles_deg": {}, "azimuth_offsets_deg": {}}})", text, level, level),
            std::string(model.name), Rigid::identity());
        if (decoder->kind(packet) == PacketKind::Lidar)
          texts.push_back(fmt::format(R"({{{}, "angles": "ANGLES.csv"}})", text));
      }
  return texts;
}

SensorPorts defaultPorts() { return {kOusterLidarPort, kOusterImuPort}; }
}  // namespace scanloom
