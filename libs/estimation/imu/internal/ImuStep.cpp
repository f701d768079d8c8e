#include "estimation/imu/internal/ImuStep.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace scanloom
{
void requireIncreasingStamps(const std::vector<ImuSample>& samples)
{
  const auto notAfter = [](const ImuSample& a, const ImuSample& b) { return b.stamp <= a.stamp; };
  const auto wrong = std::adjacent_find(samples.begin(), samples.end(), notAfter);
  if (wrong != samples.end())
    throw std::invalid_argument(fmt::format("IMU sample at {} ns is followed by one at {} ns: stamps must increase",
                                            nanoseconds(wrong->stamp), nanoseconds(std::next(wrong)->stamp)));
}

ImuSample interpolate(const ImuSample& first, const ImuSample& second, Timestamp stamp)
{
  const double share = seconds(stamp - first.stamp) / seconds(second.stamp - first.stamp);
  return {stamp, (1 - share) * first.gyro + share * second.gyro, (1 - share) * first.accel + share * second.accel,
          second.after_refused};
}

ImuDelta advance(const ImuDelta& start, const ImuSample& first, const ImuSample& second, const ImuBias& bias)
{
  const double dt = seconds(second.stamp - first.stamp);
  const Eigen::Vector3d rate = 0.5 * (first.gyro + second.gyro) - bias.gyro;

  ImuDelta end;
  end.rotation = (start.rotation * expSo3(rate * dt)).normalized();
  const Eigen::Vector3d first_force = start.rotation * (first.accel - bias.accel);
  const Eigen::Vector3d second_force = end.rotation * (second.accel - bias.accel);
  end.velocity = start.velocity + 0.5 * dt * (first_force + second_force);
  end.position = start.position + start.velocity * dt + dt * dt / 6 * (2 * first_force + second_force);
  return end;
}

NavState compose(const NavState& from, const ImuDelta& delta, Timestamp end)
{
  const double dt = seconds(end - from.stamp);
  const Rigid& pose = from.map_T_imu;
  NavState to = from;
  to.stamp = end;
  to.map_T_imu.rotation = (pose.rotation * delta.rotation).normalized();
  to.map_T_imu.translation =
      pose.translation + from.velocity * dt + 0.5 * dt * dt * gravityInMap() + pose.rotation * delta.position;
  to.velocity = from.velocity + dt * gravityInMap() + pose.rotation * delta.velocity;
  return to;
}
}  // namespace scanloom
