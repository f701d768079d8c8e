#include "estimation/slam/internal/BodyPoses.h"

#include "estimation/imu/Preintegration.h"

#include <algorithm>

namespace scanloom
{
std::vector<Rigid> bodyAtColumns(const Scan& scan, const NavState& from, const std::vector<ImuSample>& samples,
                                 const Rigid& imu_T_body)
{
  std::vector<Timestamp> stamps;
  for (const Column& column : scan.columns) stamps.push_back(std::max(column.stamp, from.stamp));
  std::sort(stamps.begin(), stamps.end());
  stamps.erase(std::unique(stamps.begin(), stamps.end()), stamps.end());
  const std::vector<NavState> states = predictAt(from, samples, stamps);

  std::vector<Rigid> poses;
  for (const Column& column : scan.columns)
  {
    const auto stamp = std::lower_bound(stamps.begin(), stamps.end(), std::max(column.stamp, from.stamp));
    poses.push_back(states[static_cast<std::size_t>(stamp - stamps.begin())].map_T_imu * imu_T_body);
  }
  return poses;
}

Trajectory posesBetween(const NavState& from, const NavState& to, const std::vector<ImuSample>& samples,
                        const Rigid& imu_T_body)
{
  std::vector<Timestamp> stamps;
  for (const ImuSample& sample : samples)
    if (sample.stamp > from.stamp) stamps.push_back(sample.stamp);
  const std::vector<NavState> states = predictAt(from, samples, stamps);
  if (states.empty()) return {};

  const Vector6d gap = boxMinus(to.map_T_imu * imu_T_body, states.back().map_T_imu * imu_T_body);
  Trajectory poses;
  for (const NavState& state : states)
  {
    const double share = seconds(state.stamp - from.stamp) / seconds(to.stamp - from.stamp);
    poses.push_back({state.stamp, boxPlus(state.map_T_imu * imu_T_body, share * gap)});
  }
  return poses;
}
}  // namespace scanloom
