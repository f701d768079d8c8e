#include "lab/simulation/internal/OusterEndpoints.h"

#include <nlohmann/json.hpp>

namespace scanloom
{
namespace
{
using nlohmann::json;

const std::string kMetadata = "/api/v1/sensor/metadata", kConfig = "/api/v1/sensor/config";

/** What the endpoint of the firmware tells: "ousteros-image-prod-aries-v2.3.0+20220415163956". */
std::string imageOf(const json& sections)
{
  const json info = sections.value("sensor_info", json::object());
  return info.value("image_rev", info.value("build_rev", "v3.0.0"));
}

std::optional<std::string> section(const json& sections, const std::string& name)
{
  const auto found = sections.find(name);
  if (found == sections.end()) return std::nullopt;
  return found->dump();
}
}  // namespace

OusterEndpoints::OusterEndpoints(const json& sections) : sections_(std::make_unique<json>(sections)) {}
OusterEndpoints::OusterEndpoints(const std::string& sections_text) : OusterEndpoints(json::parse(sections_text)) {}
OusterEndpoints::~OusterEndpoints() = default;

std::optional<std::string> OusterEndpoints::get(const std::string& path) const
{
  if (path == "/api/v1/system/firmware") return json{{"fw", imageOf(*sections_)}}.dump();
  if (path == kMetadata) return sections_->dump();
  if (path == kConfig) return section(*sections_, "config_params");
  if (path.rfind(kMetadata + "/", 0) == 0) return section(*sections_, path.substr(kMetadata.size() + 1));
  return std::nullopt;
}

std::optional<std::string> OusterEndpoints::post(const std::string& path, const std::string& body, bool reinitialise)
{
  const json change = json::parse(body, nullptr, false);
  if (path != kConfig || !change.is_object()) return std::nullopt;
  (*sections_)["config_params"].update(change);
  if (reinitialise) restart((*sections_)["sensor_info"].value("initialization_id", 0U) + 1);
  return "{}";
}

void OusterEndpoints::restart(std::uint32_t init_id) { (*sections_)["sensor_info"]["initialization_id"] = init_id; }
}  // namespace scanloom
