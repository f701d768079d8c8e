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

/** What is wrong with a text or a value, as nlohmann says it behind its own name and number of the error. */
inline std::string reasonOf(const nlohmann::json::exception& error)
{
  const std::string what = error.what();
  const std::size_t prefix = what.find("] ");
  return prefix == std::string::npos ? what : what.substr(prefix + 2);
}
}  // namespace scanloom
