#include "input/packets/OusterHttp.h"

#include "base/core/Text.h"
#include "input/lidar/OusterMetadata.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

namespace scanloom
{
namespace
{
using nlohmann::json;

const std::string kFirmware = "/api/v1/system/firmware", kMetadata = "/api/v1/sensor/metadata",
                  kSensorInfo = kMetadata + "/sensor_info", kConfig = "/api/v1/sensor/config",
                  kOldCommands = "/api/v1/sensor/cmd/", kOldConfig = kOldCommands + "get_config_param?args=active";

constexpr int kOldestMajorVersion = 2;

/** A section of the nested layout; the endpoint has the same name. The parser has defaults for those not needed. */
struct MetadataSection
{
  const char* name;
  bool needed;
};
constexpr MetadataSection kSections[] = {
    {"sensor_info", true},      {"beam_intrinsics", true}, {"lidar_data_format", false}, {"lidar_intrinsics", false},
    {"imu_data_format", false}, {"imu_intrinsics", false}, {"calibration_status", false}};

SensorHttpError malformed(const SensorHttp& sensor, const std::string& endpoint, const std::string& text)
{
  return sensor.error(SensorFault::Malformed, endpoint,
                      fmt::format("answered {} bytes that are no JSON object: ask again, and restart the sensor if it "
                                  "stays so",
                                  text.size()));
}

json parsed(const SensorHttp& sensor, const std::string& endpoint, const std::string& text)
{
  json value = json::parse(text, nullptr, false);
  if (!value.is_object()) throw malformed(sensor, endpoint, text);
  return value;
}

std::string textOf(const json& object, const char* key)
{
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? printable(found->get<std::string>()) : std::string{};
}

/** "ousteros-image-prod-aries-v2.3.0+20220415163956" -> "2.3.0"; empty if there is no version. */
std::string versionIn(const std::string& image)
{
  for (std::size_t v = image.find('v'); v != std::string::npos; v = image.find('v', v + 1))
  {
    const std::size_t end = std::min(image.find_first_not_of("0123456789.", v + 1), image.size());
    if (end > v + 1 && std::isdigit(static_cast<unsigned char>(image[v + 1]))) return image.substr(v + 1, end - v - 1);
  }
  return "";
}

/** The answer of an endpoint that every sensor with firmware 2.1 or newer has. */
std::string answerOf(SensorHttp& sensor, const std::string& endpoint)
{
  if (std::optional<std::string> answer = sensor.get(endpoint)) return *std::move(answer);
  throw sensor.error(
      SensorFault::Refused, endpoint,
      "there is no such endpoint (404): this is no Ouster sensor, or its firmware is older than 2.1. Update it, "
      "or name a file with its metadata in the key 'metadata' (for other makers: params/lidars/)");
}

void refuseOldFirmware(SensorHttp& sensor)
{
  const std::string version = versionIn(textOf(parsed(sensor, kFirmware, answerOf(sensor, kFirmware)), "fw"));
  if (version.empty())
    throw sensor.error(SensorFault::Malformed, kFirmware, "names no version in 'fw': this is no Ouster sensor");
  if (std::strtol(version.c_str(), nullptr, 10) < kOldestMajorVersion)
    throw sensor.error(SensorFault::WrongFirmware, kFirmware,
                       fmt::format("firmware {} does not tell its metadata over HTTP: update it to 2.1 or newer, or "
                                   "save its metadata to a file and name that in the key 'metadata'",
                                   version));
}

void refuseUnlessRunning(SensorHttp& sensor)
{
  const std::string status = textOf(parsed(sensor, kSensorInfo, answerOf(sensor, kSensorInfo)), "status");
  if (status.empty())
    throw sensor.error(SensorFault::Malformed, kSensorInfo, "has no text 'status': this is no Ouster sensor");
  if (status == "RUNNING") return;
  std::string mend = "look at the alerts on its web page";
  if (status == "INITIALIZING" || status == "UPDATING" || status == "WARMUP") mend = "wait until it has finished";
  if (status == "STANDBY") mend = "set its operating_mode to NORMAL";
  throw sensor.error(SensorFault::NotRunning, kSensorInfo, fmt::format("status is {}, not RUNNING: {}", status, mend));
}

json assembledFromSections(SensorHttp& sensor)
{
  json metadata = json::object();
  for (const MetadataSection& section : kSections)
  {
    const std::string endpoint = fmt::format("{}/{}", kMetadata, section.name);
    const std::optional<std::string> text = section.needed ? answerOf(sensor, endpoint) : sensor.get(endpoint);
    if (!text) continue;
    json value = json::parse(*text, nullptr, false);
    // For a section that it does not have, firmware 2.0 answers with an error as a JSON string.
    if (!value.is_object() && (section.needed || !value.is_string())) throw malformed(sensor, endpoint, *text);
    metadata[section.name] = std::move(value);
  }
  return metadata;
}

json currentConfig(SensorHttp& sensor)
{
  if (const auto text = sensor.get(kConfig)) return parsed(sensor, kConfig, *text);
  return parsed(sensor, kOldConfig, answerOf(sensor, kOldConfig));
}

void refuseUnreadable(const SensorHttp& sensor, const std::string& metadata)
{
  try
  {
    parseOusterMetadata(metadata, "metadata");
  }
  catch (const std::invalid_argument& problem)
  {
    throw sensor.error(SensorFault::Malformed, kMetadata, problem.what());
  }
}
}  // namespace

std::string fetchOusterMetadata(SensorHttp& sensor)
{
  refuseOldFirmware(sensor);
  refuseUnlessRunning(sensor);

  const std::optional<std::string> whole = sensor.get(kMetadata);
  json metadata = whole ? parsed(sensor, kMetadata, *whole) : assembledFromSections(sensor);
  const auto config = metadata.find("config_params");
  if (config == metadata.end() || !config->is_object()) metadata["config_params"] = currentConfig(sensor);

  std::string text = metadata.dump(2, ' ', false, json::error_handler_t::replace);
  refuseUnreadable(sensor, text);
  return text;
}

bool setOusterDestination(SensorHttp& sensor, const IpAddress& destination)
{
  refuseUnlessRunning(sensor);  // after an earlier call it restarts
  const std::string wanted = destination.text();
  if (textOf(currentConfig(sensor), "udp_dest") == wanted) return false;
  if (sensor.post(kConfig + "?reinit=true&persist=false", json{{"udp_dest", wanted}}.dump())) return true;

  answerOf(sensor, fmt::format("{}set_config_param?args=udp_dest+{}", kOldCommands, wanted));
  answerOf(sensor, kOldCommands + "reinitialize");
  return true;
}
}  // namespace scanloom
