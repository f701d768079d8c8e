#pragma once
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace scanloom
{
/** What the web interface of an Ouster sensor answers, without the web. */
class OusterEndpoints
{
 public:
  /** `sections` as sensorSections() gives them; `old` as firmware 2.1: metadata in sections only, configuration by
   * commands. After a restart the status is INITIALIZING for as long as `initialising`. */
  OusterEndpoints(nlohmann::json sections, bool old, std::chrono::nanoseconds initialising);

  /** Nothing where there is no such endpoint. */
  std::optional<nlohmann::json> get(const std::string& path, const std::string& arguments);
  std::optional<nlohmann::json> postConfig(const std::string& body, bool reinitialise);

  void restart(std::uint32_t init_id);
  void replace(nlohmann::json sections) { sections_ = std::move(sections); }
  void setStatus(const std::string& status) { sections_["sensor_info"]["status"] = status; }

  const nlohmann::json& sections() const { return sections_; }

 private:
  using Clock = std::chrono::steady_clock;

  nlohmann::json sensorInfo() const;
  std::optional<nlohmann::json> section(const std::string& name) const;
  std::optional<nlohmann::json> command(const std::string& name, const std::string& arguments);
  void reinitialise();

  nlohmann::json sections_, staged_ = nlohmann::json::object();
  bool old_;
  std::chrono::nanoseconds initialising_;
  Clock::time_point running_from_ = Clock::time_point::min();
};
}  // namespace scanloom
