#include "base/positions/PositionTrack.h"

#include "base/formats/SecondsText.h"
#include "base/formats/Trajectory.h"

#include <fmt/format.h>

#include <string>

namespace scanloom
{
namespace
{
constexpr Duration kLongestGap = 2s;

std::string spanText(const PositionTrack& track)
{
  if (track.empty()) return "nothing";
  return fmt::format("{} to {} s", secondsText(track.front().stamp), secondsText(track.back().stamp));
}
}  // namespace

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
  for (const StampedPosition& measured : reference)
    if (const auto pose = poseAt(estimate, measured.stamp, kLongestGap))
      pairs.push_back({measured.stamp, *pose * body_p_point, measured.position});
  return pairs;
}

double coverage(const std::vector<PositionPair>& pairs, const PositionTrack& reference)
{
  if (reference.size() < 2) return pairs.empty() ? 0 : 1;
  Duration covered{0};
  auto pair = pairs.begin();
  bool before = false;
  for (std::size_t i = 0; i < reference.size(); ++i)
  {
    const bool here = pair != pairs.end() && pair->stamp == reference[i].stamp;
    if (before && here) covered += reference[i].stamp - reference[i - 1].stamp;
    if (here) ++pair;
    before = here;
  }
  return seconds(covered) / seconds(reference.back().stamp - reference.front().stamp);
}
}  // namespace scanloom
