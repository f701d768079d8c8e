#include "simulation/OusterEndpoints.h"

namespace scanloom
{
namespace
{
using nlohmann::json;

const std::string kMetadata = "/api/v1/sensor/metadata", kCommands = "/api/v1/sensor/cmd/";

bool startsWith(const std::string& text, const std::string& beginning) { return text.rfind(beginning, 0) == 0; }

/** "ousteros-image-prod-aries-v2.3.0+20220415163956": what the firmware's endpoint says. */
std::string imageOf(const json& sections)
{
  const json info = sections.value("sensor_info", json::object());
  return info.value("image_rev", info.value("build_rev", "v3.0.0"));
}
}  // namespace

OusterEndpoints::OusterEndpoints(json sections, bool old, std::chrono::nanoseconds initialising)
  : sections_(std::move(sections)), old_(old), initialising_(initialising)
{
}

std::optional<json> OusterEndpoints::get(const std::string& path, const std::string& arguments)
{
  if (path == "/api/v1/system/firmware") return json{{"fw", imageOf(sections_)}};
  if (path == kMetadata + "/sensor_info") return sensorInfo();
  if (startsWith(path, kMetadata + "/")) return section(path.substr(kMetadata.size() + 1));
  if (old_) return startsWith(path, kCommands) ? command(path.substr(kCommands.size()), arguments) : std::nullopt;

  if (path == "/api/v1/sensor/config") return section("config_params");
  if (path != kMetadata) return std::nullopt;
  json whole = sections_;
  whole["sensor_info"] = sensorInfo();
  return whole;
}

std::optional<json> OusterEndpoints::postConfig(const std::string& body, bool restarts)
{
  const json change = json::parse(body, nullptr, false);
  if (old_ || !change.is_object()) return std::nullopt;
  sections_["config_params"].update(change);
  if (restarts) reinitialise();
  return json::object();
}

void OusterEndpoints::restart(std::uint32_t init_id)
{
  sections_["sensor_info"]["initialization_id"] = init_id;
  sections_["sensor_info"]["status"] = "RUNNING";
  running_from_ = Clock::now() + initialising_;
}

json OusterEndpoints::sensorInfo() const
{
  json info = sections_.value("sensor_info", json::object());
  if (Clock::now() < running_from_) info["status"] = "INITIALIZING";
  return info;
}

std::optional<json> OusterEndpoints::section(const std::string& name) const
{
  const auto found = sections_.find(name);
  if (found == sections_.end()) return std::nullopt;
  return *found;
}

std::optional<json> OusterEndpoints::command(const std::string& name, const std::string& arguments)
{
  if (name == "get_config_param" && arguments == "active") return section("config_params");
  const std::size_t space = arguments.find(' ');
  if (name == "set_config_param" && space != std::string::npos)
  {
    staged_[arguments.substr(0, space)] = arguments.substr(space + 1);
    return json(name);
  }
  if (name != "reinitialize") return std::nullopt;
  sections_["config_params"].update(staged_);
  reinitialise();
  return json::object();
}

void OusterEndpoints::reinitialise() { restart(sections_["sensor_info"].value("initialization_id", 0U) + 1); }
}  // namespace scanloom
