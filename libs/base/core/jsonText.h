#pragma once
#include <nlohmann/json.hpp>

#include <string>

namespace scanloom
{
/**
 * JSON as text. Names of files and labels in damaged recordings may be no UTF-8, for which dump() throws: what is none
 * becomes U+FFFD.
 */
inline std::string jsonText(const nlohmann::json& json, int indentation = 2)
{
  return json.dump(indentation, ' ', false, nlohmann::json::error_handler_t::replace);
}
}  // namespace scanloom
