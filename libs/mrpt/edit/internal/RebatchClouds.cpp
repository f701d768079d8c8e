#include "mrpt/edit/internal/RebatchClouds.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/observations/Observations.h"
#include "mrpt/observations/PointSelection.h"
#include "mrpt/observations/RawlogReader.h"
#include "mrpt/observations/RecordingHeaderJson.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
using mrpt::maps::CGenericPointsMap;
using mrpt::obs::CObservationPointCloud;

std::int64_t toNanoseconds(float t) { return std::llround(1e9 * static_cast<double>(t)); }

/** Time of each point after the cloud's stamp. */
std::vector<Duration> timesOf(const CObservationPointCloud& cloud)
{
  requireTimes(cloud);
  const auto* t = genericCloudOf(cloud).getPointsBufferRef_float_field("t");
  const auto* rest = genericCloudOf(cloud).getPointsBufferRef_float_field(kRestField);
  std::vector<Duration> times;
  times.reserve(t->size());
  for (std::size_t i = 0; i < t->size(); ++i)
    times.emplace_back(toNanoseconds((*t)[i]) + (rest ? std::llround((*rest)[i]) : 0));
  return times;
}

void setTimes(const std::vector<Duration>& times, CGenericPointsMap& cloud)
{
  auto& t = *cloud.getPointsBufferRef_float_field("t");
  for (std::size_t i = 0; i < times.size(); ++i) t[i] = static_cast<float>(seconds(times[i]));
}

void addRests(const std::vector<Duration>& times, CGenericPointsMap& cloud)
{
  cloud.registerField_float(kRestField);
  const auto& t = *cloud.getPointsBufferRef_float_field("t");
  auto& rest = *cloud.getPointsBufferRef_float_field(kRestField);
  for (std::size_t i = 0; i < times.size(); ++i) rest[i] = static_cast<float>(times[i].count() - toNanoseconds(t[i]));
}

struct Periods
{
  Duration scans;     // of the input
  Duration windows;   // of the output
  Duration recorded;  // of the recording: within this the float t is exact enough
};

/** Makes windows of the scans of one label. */
class Windows
{
 public:
  Windows(Timestamp origin, const Periods& periods) : origin_(origin), periods_(periods) {}

  /** Returns the windows that are complete with this scan, oldest first. */
  Observations add(const CObservationPointCloud& scan)
  {
    const Timestamp start = fromMrpt(scan.timestamp);
    const std::int64_t first = numberOf(start), last = numberOf(start + periods_.scans - Duration{1});
    const std::vector<Duration> t = timesOf(scan);
    std::vector<std::vector<std::uint32_t>> points(
        static_cast<std::size_t>(std::max<std::int64_t>(0, last - first) + 1));
    for (std::size_t i = 0; i < t.size(); ++i)
    {
      const std::int64_t number = std::clamp(numberOf(start + t[i]), first, last);
      points[static_cast<std::size_t>(number - first)].push_back(static_cast<std::uint32_t>(i));
    }

    Observations complete;
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const std::int64_t number = first + static_cast<std::int64_t>(k);
      if (!parts_.empty() && number != number_) complete.push_back(release());
      number_ = number;
      parts_.push_back(part(scan, points[k], t));
      if (startOf(number + 1) <= start + periods_.scans) complete.push_back(release());
    }
    return complete;
  }

  Observations finish() { return parts_.empty() ? Observations{} : Observations{release()}; }

 private:
  Timestamp startOf(std::int64_t number) const { return origin_ + number * periods_.windows; }

  /** Scans come in order; only after a clock step can a time be before the origin, and window 0 then takes it. */
  std::int64_t numberOf(Timestamp t) const { return std::max<std::int64_t>(0, (t - origin_) / periods_.windows); }

  struct Part
  {
    CloudPtr cloud;
    std::vector<Duration> times;  // after the window's stamp
  };

  Part part(const CObservationPointCloud& scan, const std::vector<std::uint32_t>& points,
            const std::vector<Duration>& times) const
  {
    Part part{withPoints(scan, selected(genericCloudOf(scan), points, kRestField)), {}};
    part.cloud->timestamp = toMrpt(startOf(number_));
    const Duration shift = fromMrpt(scan.timestamp) - fromMrpt(part.cloud->timestamp);
    for (const std::uint32_t i : points) part.times.push_back(times[i] + shift);
    return part;
  }

  ObservationPtr release()
  {
    std::vector<CGenericPointsMap::Ptr> clouds;
    std::vector<Duration> times;
    for (const Part& part : parts_)
    {
      clouds.push_back(std::dynamic_pointer_cast<CGenericPointsMap>(part.cloud->pointcloud));
      times.insert(times.end(), part.times.begin(), part.times.end());
    }
    const auto whole = joined(clouds);
    setTimes(times, *whole);
    if (periods_.windows > periods_.recorded) addRests(times, *whole);
    auto window = withPoints(*parts_.front().cloud, whole);
    parts_.clear();
    return window;
  }

  Timestamp origin_;
  Periods periods_;
  std::int64_t number_ = 0;  // of the window being filled
  std::vector<Part> parts_;
};

class Rebatcher
{
 public:
  Rebatcher(double scan_rate, const RecordingHeader& header) : scan_rate_(scan_rate)
  {
    if (header.scan_rate <= 0) throw std::invalid_argument("the rawlog's header does not name the rate of its scans");
    periods_.scans = header.period();
    periods_.windows = fromSeconds(1 / scan_rate);
    periods_.recorded = header.recorded_rate > 0 ? fromSeconds(1 / header.recorded_rate) : periods_.scans;
  }

  Observations operator()(const ObservationPtr& observation)
  {
    if (!observation) return finish();
    if (headerIn(*observation))
    {
      auto& text = dynamic_cast<mrpt::obs::CObservationComment&>(*observation).text;
      text = withScanRate(text, scan_rate_);
      return {observation};
    }
    const auto cloud = cloudIn(observation);
    if (!cloud) return {observation};
    if (isSlice(*cloud)) return {};
    const Timestamp stamp = fromMrpt(cloud->timestamp);
    const auto windows = windows_.try_emplace(cloud->sensorLabel, stamp, periods_).first;
    return windows->second.add(*cloud);
  }

 private:
  Observations finish()
  {
    Observations last;
    for (auto& [label, windows] : windows_)
      for (ObservationPtr& window : windows.finish()) last.push_back(std::move(window));
    return last;
  }

  double scan_rate_;  // Hz
  Periods periods_;
  std::map<std::string, Windows> windows_;
};
}  // namespace

RawlogOperation rebatch(double scan_rate, const RecordingHeader& header) { return Rebatcher(scan_rate, header); }
}  // namespace scanloom
