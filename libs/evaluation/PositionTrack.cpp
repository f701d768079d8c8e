#include "evaluation/PositionTrack.h"

#include "formats/SecondsText.h"
#include "formats/Trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

namespace scanloom
{
namespace
{
constexpr Duration kLongestGap = 2s;

std::optional<StampedPosition> parseMeasurement(std::string line)
{
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream words(line);
  std::string stamp;
  Eigen::Vector3d p;
  if (!(words >> stamp >> p.x() >> p.y() >> p.z()) || !p.allFinite()) return std::nullopt;
  const auto time = parseSeconds(stamp);
  if (!time) return std::nullopt;
  return StampedPosition{*time, p};
}

std::string spanText(const PositionTrack& track)
{
  if (track.empty()) return "nothing";
  return fmt::format("{} to {} s", secondsText(track.front().stamp), secondsText(track.back().stamp));
}

bool isHeader(const std::string& line) { return line.find_first_of("0123456789") == std::string::npos; }
}  // namespace

PositionTrack readTotalStation(const std::filesystem::path& path)
{
  std::ifstream file(path);
  if (!file) throw std::invalid_argument(fmt::format("cannot read the total station's '{}'", path.string()));

  PositionTrack track;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number)
  {
    if (line.rfind('#', 0) == 0 || (track.empty() && isHeader(line))) continue;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const auto measurement = parseMeasurement(line);
    if (!measurement)
      throw std::invalid_argument(
          fmt::format("{}:{}: expected 't,x,y,z' in s and m, found '{}'", path.string(), number, line));
    if (!track.empty() && measurement->stamp <= track.back().stamp)
      throw std::invalid_argument(fmt::format("{}:{}: stamp {} is not after {}: sort the file by time", path.string(),
                                              number, secondsText(measurement->stamp),
                                              secondsText(track.back().stamp)));
    track.push_back(*measurement);
  }
  return track;
}

PositionTrack positionsOf(const Trajectory& trajectory, const Eigen::Vector3d& body_p_point)
{
  PositionTrack track;
  for (const StampedPose& pose : trajectory) track.push_back({pose.stamp, pose.map_T_body * body_p_point});
  return track;
}

std::invalid_argument shareNoTime(const PositionTrack& estimate, const PositionTrack& reference)
{
  return std::invalid_argument(fmt::format("the trajectory ({}) and the reference ({}) have no time in common",
                                           spanText(estimate), spanText(reference)));
}

std::vector<PositionPair> pairsAtReference(const Trajectory& estimate, const Eigen::Vector3d& body_p_point,
                                           const PositionTrack& reference)
{
  std::vector<PositionPair> pairs;
  for (const auto& [stamp, position] : reference)
    if (const auto pose = poseAt(estimate, stamp, kLongestGap))
      pairs.push_back({stamp, *pose * body_p_point, position});
  return pairs;
}
}  // namespace scanloom
