#pragma once
#include <algorithm>
#include <cctype>
#include <string>

namespace scanloom
{
/** Letters, digits and '_': what ROS allows in the names of frames and topics. */
inline std::string rosName(std::string label)
{
  const auto is_allowed = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  std::replace_if(
      label.begin(), label.end(), [&](unsigned char c) { return !is_allowed(c); }, '_');
  return label.empty() ? "unnamed" : label;
}
}  // namespace scanloom
