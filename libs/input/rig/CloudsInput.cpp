#include "input/rig/CloudsInput.h"

#include "base/core/Statistics.h"
#include "base/formats/SecondsText.h"
#include "input/rig/withColumns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
constexpr Duration kIntervalOfOne = 100ms;
constexpr Duration kLongestScan = 2s;                     // the points' t has 32 bits
constexpr double kAbsoluteFrom = 1e8, kAbsoluteTo = 4e9;  // s: a time from 1973 to 2096
constexpr std::uint64_t kNamed = 5;                       // clouds that are left out, each in a line

Duration medianInterval(const std::vector<Timestamp>& stamps)
{
  std::vector<Duration> intervals;
  for (std::size_t i = 1; i < stamps.size(); ++i) intervals.push_back(stamps[i] - stamps[i - 1]);
  if (intervals.empty()) return kIntervalOfOne;
  return upperMedian(std::move(intervals));
}

/** In which the times are of one scan. */
double unitOf(const std::vector<double>& times)
{
  if (times.empty()) return 1;
  const auto [least, most] = std::minmax_element(times.begin(), times.end());
  for (const double unit : {1.0, 1e-3, 1e-6})
    if ((*most - *least) * unit <= seconds(kLongestScan)) return unit;
  return 1e-9;
}

/** The places of the points in the order of their times. */
std::vector<std::uint32_t> inTimeOrder(const std::vector<double>& times)
{
  std::vector<std::uint32_t> order(times.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return times[a] < times[b]; });
  return order;
}

void setPoint(const Eigen::Vector3f& p, Duration since_start, std::size_t i, PointCloud& points)
{
  constexpr float kFarthest = 4e6F;  // m, of what 32 bits of mm can hold
  points.x[i] = p.x();
  points.y[i] = p.y();
  points.z[i] = p.z();
  points.t[i] = static_cast<std::int32_t>(since_start.count());
  points.range[i] = static_cast<std::uint32_t>(std::lround(1000 * std::min(p.norm(), kFarthest)));
}

/** A cloud of one instant, which is the scan's end: so the pose is the cloud's. */
Scan scanOfInstant(const CloudFile& cloud, Timestamp stamp, Duration interval)
{
  Scan scan;
  scan.start = stamp - interval;
  scan.period = interval;
  scan.points.resize(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    setPoint(cloud.points[i], interval - Duration{1}, i, scan.points);
  return withColumns(std::move(scan));
}

Scan scanOfTimed(const CloudFile& cloud, Timestamp stamp, Duration interval, double unit)
{
  const std::vector<std::uint32_t> order = inTimeOrder(cloud.times);
  const double first = cloud.times[order.front()] * unit;
  const auto after = [&](double time) { return fromSeconds(time * unit - first); };
  const Duration span = after(cloud.times[order.back()]);
  if (span > kLongestScan)
    throw std::invalid_argument(fmt::format("its points span {:.3g} s: no scan is longer than 2 s", seconds(span)));

  if (first < -seconds(kLongestScan) || (first > seconds(kLongestScan) && first < kAbsoluteFrom) || first > kAbsoluteTo)
    throw std::invalid_argument(
        fmt::format("its times begin at {:.3g} s: neither after its stamp, nor since 1970", first));

  Scan scan;
  scan.start = first >= kAbsoluteFrom ? Timestamp{fromSeconds(first)} : stamp + fromSeconds(first);
  scan.period = std::max(interval, span + Duration{1});
  scan.points.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    setPoint(cloud.points[order[i]], after(cloud.times[order[i]]), i, scan.points);
  return withColumns(std::move(scan));
}
}  // namespace

CloudsInput::CloudsInput(std::vector<std::filesystem::path> clouds)
  : clouds_(std::move(clouds)), times_(cloudTimes(clouds_)), interval_(medianInterval(times_.stamps))
{
  const CloudFile first = firstReadable();
  unit_ = unitOf(first.times);
  warnings_.push_back(fmt::format("{} clouds, {}{}; their stamps: {}", clouds_.size(),
                                  first.times.empty() ? "without times of points: each is taken for one instant"
                                                      : fmt::format("with times of points in units of {:g} s", unit_),
                                  first.note.empty() ? "" : ", " + first.note, times_.source));
}

/** Throws what reading the first one throws if there is none. */
CloudFile CloudsInput::firstReadable() const
{
  for (const auto& cloud : clouds_) try
    {
      return readCloud(cloud);
    }
    catch (const std::runtime_error&)
    {
      continue;
    }
  return readCloud(clouds_.front());
}

std::optional<SensorEvent> CloudsInput::next(Duration)
{
  while (!stop_ && next_ < clouds_.size()) try
    {
      Scan scan = read(next_++);
      if (scan.end() <= last_end_)
        throw std::runtime_error(
            fmt::format("{}: its points are not after those of the clouds before", clouds_[next_ - 1].string()));
      last_end_ = scan.end();
      return scan;
    }
    catch (const std::runtime_error& fault)
    {
      if (++left_out_ <= kNamed) warnings_.push_back(fmt::format("left out: {}", fault.what()));
    }
  if (!std::exchange(ended_, true) && left_out_ > kNamed)
    warnings_.push_back(fmt::format("left out: {} clouds in all", left_out_));
  return std::nullopt;
}

Scan CloudsInput::read(std::size_t i) const
try
{
  const CloudFile cloud = readCloud(clouds_[i]);
  return cloud.times.empty() ? scanOfInstant(cloud, times_.stamps[i], interval_)
                             : scanOfTimed(cloud, times_.stamps[i], interval_, unit_);
}
catch (const std::invalid_argument& error)
{
  throw std::runtime_error(fmt::format("{}: {}", clouds_[i].string(), error.what()));
}

SensorSetup CloudsInput::setup() const
{
  SensorSetup setup;
  setup.header.lidars.resize(1);
  setup.header.lidars[0].name = "clouds";
  setup.header.scan_rate = 1 / seconds(interval_);
  return setup;
}

double CloudsInput::progress() const { return static_cast<double>(next_) / static_cast<double>(clouds_.size()); }

RigAccount CloudsInput::account() const
{
  RigAccount account;
  account.input = {{"clouds", next_ - left_out_}, {kDamagedInputs, left_out_}};
  return account;
}

std::vector<std::string> CloudsInput::takeWarnings() { return std::exchange(warnings_, {}); }
}  // namespace scanloom
