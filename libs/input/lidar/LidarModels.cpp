#include "input/lidar/LidarModels.h"

#include "input/lidar/BuiltInModels.h"
#include "input/lidar/CloudDecoder.h"
#include "input/lidar/OusterDecoder.h"
#include "input/lidar/internal/HesaiDecoder.h"
#include "input/lidar/internal/RobosenseDecoder.h"
#include "input/lidar/internal/VelodyneDecoder.h"

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
  const char* described;  // what its metadata file is, for the error that lists the families
  bool (*recognises)(const std::string& metadata_text);
  std::unique_ptr<PacketDecoder> (*make)(const std::string& metadata_text, const std::string& file_name,
                                         const Rigid& body_T_sensor);
};

std::unique_ptr<PacketDecoder> makeOuster(const std::string& text, const std::string& name, const Rigid& body_T_sensor)
{
  return std::make_unique<OusterDecoder>(parseOusterMetadata(text, name), body_T_sensor);
}

std::unique_ptr<PacketDecoder> makeVelodyne(const std::string& text, const std::string& name,
                                            const Rigid& body_T_sensor)
{
  return std::make_unique<VelodyneDecoder>(parseVelodyneMetadata(text, name), body_T_sensor);
}

std::unique_ptr<PacketDecoder> makeHesai(const std::string& text, const std::string& name, const Rigid& body_T_sensor)
{
  return std::make_unique<HesaiDecoder>(parseHesaiMetadata(text, name), body_T_sensor);
}

std::unique_ptr<PacketDecoder> makeRobosense(const std::string& text, const std::string& name,
                                             const Rigid& body_T_sensor)
{
  return std::make_unique<RobosenseDecoder>(parseRobosenseMetadata(text, name), body_T_sensor);
}

std::unique_ptr<PacketDecoder> makeCloud(const std::string& text, const std::string& name, const Rigid& body_T_sensor)
{
  return std::make_unique<CloudDecoder>(parseCloudMetadata(text, name), body_T_sensor);
}

const std::array<LidarFamily, 5> kFamilies{{
    {"a JSON file that begins with \"lidar\": \"velodyne\" (params/lidars/)", &looksLikeVelodyne, &makeVelodyne},
    {"a JSON file that begins with \"lidar\": \"hesai\" (params/lidars/)", &looksLikeHesai, &makeHesai},
    {"a JSON file that begins with \"lidar\": \"robosense\" (params/lidars/)", &looksLikeRobosense, &makeRobosense},
    {R"(the text {"lidar": "cloud"} for clouds of a bag)", &looksLikeCloud, &makeCloud},
    {"the JSON text of an Ouster sensor's metadata", &looksLikeOuster, &makeOuster},
}};
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
    if (family.recognises(metadata_text)) return family.make(metadata_text, name, body_T_sensor);
    expected += fmt::format("{}{}", expected.empty() ? "" : ", or ", family.described);
  }
  throw std::invalid_argument(fmt::format("{}: belongs to no known lidar; expected {}", name, expected));
}

bool isLidarMetadata(const std::string& text)
{
  return std::any_of(kFamilies.begin(), kFamilies.end(),
                     [&](const LidarFamily& family) { return family.recognises(text); });
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
  const auto addIfItFits = [&](const char* family, std::string_view model, int channels)
  {
    if (builtInMetadata(std::string(model))) return;
    for (const int returns : {1, 2})
    {
      const std::string text = fmt::format(R"("lidar": "{}", "model": "{}", "returns": {})", family, model, returns);
      const std::vector<double> level(static_cast<std::size_t>(channels), 0.0);
      const auto decoder = makeDecoder(
          fmt::format(R"({{{}, "vertical_angles_deg": {}, "azimuth_offsets_deg": {}}})", text, level, level),
          std::string(model), Rigid::identity());
      if (decoder->kind(packet) == PacketKind::Lidar)
        texts.push_back(fmt::format(R"({{{}, "angles": "ANGLES.csv"}})", text));
    }
  };
  for (const HesaiModel& model : kHesaiModels) addIfItFits("hesai", model.name, model.channels);
  for (const RobosenseModel& model : kRobosenseModels) addIfItFits("robosense", model.name, model.channels);
  return texts;
}

SensorPorts defaultPorts() { return {kOusterLidarPort, kOusterImuPort}; }
}  // namespace scanloom
