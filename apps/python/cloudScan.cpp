#include "cloudScan.h"

#include "base/core/ConfigError.h"
#include "input/rig/withColumns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace scanloom
{
namespace
{
constexpr Duration kLongestScan = 2s;         // the points' t has 32 bits
constexpr Duration kPeriodOfInstant = 100ms;  // of a cloud whose points have no times

void refuseOutside(const char* name, const std::vector<std::int64_t>& values, std::int64_t end)
{
  for (const std::int64_t value : values)
    if (value < 0 || value >= end)
      throw UsageError(fmt::format("{} has {}: must be from 0 to {}", name, value, end - 1));
}

void refuseLength(const char* name, const std::vector<std::int64_t>& values, std::size_t points)
{
  if (!values.empty() && values.size() != points)
    throw UsageError(fmt::format("{} has {} values, xyz {} points: must be as many", name, values.size(), points));
}

void refuseWrong(const CloudArrays& cloud, Duration period, std::size_t lidars)
{
  for (const auto& [name, values, end] : {std::tuple{"t", &cloud.t, static_cast<std::int64_t>(period.count())},
                                          std::tuple{"lidar", &cloud.lidar, static_cast<std::int64_t>(lidars)},
                                          std::tuple{"ring", &cloud.ring, std::int64_t{256}},
                                          std::tuple{"intensity", &cloud.intensity, std::int64_t{256}}})
  {
    refuseLength(name, *values, cloud.xyz.size());
    refuseOutside(name, *values, end);
  }
}

std::int64_t valueAt(const std::vector<std::int64_t>& values, std::size_t i) { return values.empty() ? 0 : values[i]; }

/** Places of the finite points in the order of columns. */
std::vector<std::size_t> inColumnOrder(const CloudArrays& cloud)
{
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < cloud.xyz.size(); ++i)
    if (cloud.xyz[i].allFinite()) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b)
                   {
                     return std::pair(valueAt(cloud.t, a), valueAt(cloud.lidar, a)) <
                            std::pair(valueAt(cloud.t, b), valueAt(cloud.lidar, b));
                   });
  return order;
}

Duration periodOf(const CloudArrays& cloud)
{
  if (cloud.t.empty()) return kPeriodOfInstant;
  return Duration{*std::max_element(cloud.t.begin(), cloud.t.end()) + 1};
}

std::uint32_t millimetres(const Eigen::Vector3f& p, const Rigid& body_T_sensor)
{
  constexpr double kFarthest = 4e6;  // m, of what 32 bits of mm can hold
  const double metres = (p.cast<double>() - body_T_sensor.translation).norm();
  return static_cast<std::uint32_t>(std::lround(1000 * std::min(metres, kFarthest)));
}
}  // namespace

Scan cloudScan(Timestamp stamp, std::optional<Duration> given_period, const CloudArrays& cloud,
               const std::vector<MountedLidar>& lidars)
{
  Scan scan;
  scan.period = given_period.value_or(periodOf(cloud));
  if (scan.period <= Duration{0} || scan.period > kLongestScan)
    throw UsageError(
        fmt::format("a scan of {} s: must be above 0 and at most {} s", seconds(scan.period), seconds(kLongestScan)));
  refuseWrong(cloud, scan.period, lidars.size());
  scan.start = cloud.t.empty() ? stamp - scan.period : stamp;

  const std::vector<std::size_t> order = inColumnOrder(cloud);
  PointCloud& points = scan.points;
  points.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const std::size_t from = order[i];
    const Eigen::Vector3f& p = cloud.xyz[from];
    points.x[i] = p.x();
    points.y[i] = p.y();
    points.z[i] = p.z();
    points.t[i] = static_cast<std::int32_t>(cloud.t.empty() ? scan.period.count() - 1 : cloud.t[from]);
    points.sensor_id[i] = static_cast<std::uint8_t>(valueAt(cloud.lidar, from));
    points.ring[i] = static_cast<std::uint8_t>(valueAt(cloud.ring, from));
    points.intensity[i] = static_cast<std::uint8_t>(valueAt(cloud.intensity, from));
    points.range[i] = millimetres(p, lidars[points.sensor_id[i]].body_T_sensor);
  }
  return withColumns(std::move(scan));
}
}  // namespace scanloom
