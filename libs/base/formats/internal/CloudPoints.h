/** What is read of the points of a cloud file. */
#pragma once
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct CloudPoints
{
  std::vector<Eigen::Vector3f> positions;
  std::vector<double> times;  // of the points, in the file's unit; empty: it has none
  std::string note;           // what was concluded about the file; empty: nothing had to be
};

/** Which of a point's fields is its time. In a mesh, `t` stands beside `s` and is a coordinate of its texture. */
inline std::optional<std::size_t> timeField(const std::vector<std::string>& fields)
{
  constexpr std::array kNames{"time", "timestamp", "time_stamp", "offset_time"};
  const bool textured = std::find(fields.begin(), fields.end(), "s") != fields.end();
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (std::find(kNames.begin(), kNames.end(), fields[i]) != kNames.end() || (fields[i] == "t" && !textured)) return i;
  return std::nullopt;
}
}  // namespace scanloom
