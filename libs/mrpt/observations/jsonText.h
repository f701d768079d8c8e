#pragma once
#include <nlohmann/json.hpp>

#include <string>

namespace scanloom
{
/** As people read it. Labels of a damaged rawlog may be no UTF-8: what is none becomes U+FFFD. */
inline std::string jsonText(const nlohmann::json& json)
{
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}
}  // namespace scanloom
