#include "site/internal/Odometry.h"

#include "estimation/ndt/FittedConstants.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr std::size_t kAlignedTo = 3;           // keyframes; two simulated stands
constexpr double kKeyframesOfOneTilt = 10;      // through which an error of the tilt lasts: slam's gravity, 40 m
constexpr double kDriftOfAlignment = 3.0 / 14;  // of an alignment's variance, per keyframe: by the edges of odometryOf
}  // namespace

std::vector<OdometryPose> odometryOf(const std::vector<DriveKeyframe>& keyframes, std::size_t first)
{
  std::vector<OdometryPose> edges;
  std::size_t part = 0;
  for (std::size_t to = 0; to < keyframes.size(); ++to)
  {
    if (keyframes[to].begins_a_part) part = to;
    const std::size_t count = std::min(kAlignedTo, to - part);
    for (std::size_t back = 1; back <= count; ++back)
    {
      const std::size_t from = to - back;
      edges.push_back({{first + from, first + to, keyframes[from].drive_T_body.inverse() * keyframes[to].drive_T_body,
                        static_cast<double>(count) * keyframes[to].covariance},
                       first,
                       keyframes[from].body_up});
    }
  }
  return edges;
}

std::vector<MeasuredUp> upsOf(const std::vector<DriveKeyframe>& keyframes, std::size_t first)
{
  std::vector<MeasuredUp> ups;
  for (std::size_t i = 0; i < keyframes.size(); ++i)
    ups.push_back({first + i, keyframes[i].body_up, std::sqrt(kKeyframesOfOneTilt) * keyframes[i].up_sigma});
  return ups;
}

OdometryDrift::OdometryDrift(const std::vector<DriveKeyframe>& keyframes)
  : way_(keyframes.size(), 0), position_(way_), heading_(way_)
{
  for (std::size_t i = 1; i < keyframes.size(); ++i)
  {
    const DriveKeyframe& now = keyframes[i];
    const double step = (now.drive_T_body.translation - keyframes[i - 1].drive_T_body.translation).norm();
    way_[i] = way_[i - 1] + step;
    position_[i] = position_[i - 1] + kDriftOfAlignment * now.covariance.topLeftCorner<3, 3>().trace();
    heading_[i] = heading_[i - 1] + kDriftOfAlignment * now.covariance(5, 5);
  }
}

double OdometryDrift::way(std::size_t a, std::size_t b) const { return std::abs(way_[a] - way_[b]); }

double OdometryDrift::between(std::size_t a, std::size_t b) const
{
  const double length = way(a, b);
  const double of_heading = std::abs(heading_[a] - heading_[b]) * length * length / 3;  // a random walk
  const double of_scale = fitted::kScaleError * length;  // along the way, and as much upwards
  return std::sqrt(std::abs(position_[a] - position_[b]) + of_heading + 2 * of_scale * of_scale);
}
}  // namespace scanloom
