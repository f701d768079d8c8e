#pragma once
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace scanloom
{
/** What the web interface of an Ouster sensor answers to each request, without a server. */
class OusterEndpoints
{
 public:
  /** `sections`: the metadata in the nested layout, with one section per endpoint. */
  explicit OusterEndpoints(const nlohmann::json& sections);
  explicit OusterEndpoints(const std::string& sections_text);
  ~OusterEndpoints();

  /** JSON text; nothing if there is no such endpoint. */
  std::optional<std::string> get(const std::string& path) const;

  /** Takes over a new configuration, with a restart if it is to `reinitialise`. */
  std::optional<std::string> post(const std::string& path, const std::string& body, bool reinitialise);

  /** The sensor has started again, with this init id. */
  void restart(std::uint32_t init_id);

  nlohmann::json& sections() { return *sections_; }
  const nlohmann::json& sections() const { return *sections_; }

 private:
  std::unique_ptr<nlohmann::json> sections_;
};
}  // namespace scanloom
