/** What is read of the points of a cloud file. */
#pragma once
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace scanloom
{
struct CloudPoints
{
  std::vector<Eigen::Vector3f> positions;
  std::vector<double> times;  // of the points, in the file's unit; empty: it has none
};

/** Whether a field of this name is the time of a point. */
inline bool isTimeField(const std::string& name)
{
  constexpr std::array kNames{"t", "time", "timestamp", "time_stamp", "offset_time"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}
}  // namespace scanloom
