#include "mrpt/edit/internal/MergeLidars.h"

#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/RawlogHeader.h"
#include "mrpt/observations/PointSelection.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace scanloom
{
namespace
{
using mrpt::maps::CGenericPointsMap;
using mrpt::obs::CObservationPointCloud;

template <typename Key>
std::vector<std::uint32_t> orderBy(const std::vector<Key>& keys)
{
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  return order;
}

/** The parts of one scan, by lidar. */
struct PartialScan
{
  std::string label;
  mrpt::Clock::time_point stamp;
  std::vector<CloudPtr> parts;  // null: not yet here

  bool isComplete() const
  {
    return std::all_of(parts.begin(), parts.end(), [](const auto& part) { return part != nullptr; });
  }
};

CloudPtr merged(const PartialScan& scan)
{
  std::vector<CGenericPointsMap::Ptr> clouds;
  CloudPtr first;
  for (const auto& part : scan.parts)
  {
    if (!part) continue;
    genericCloudOf(*part);
    if (!first) first = part;
    clouds.push_back(std::dynamic_pointer_cast<CGenericPointsMap>(part->pointcloud));
  }
  auto whole = withPoints(*first, selected(*joined(clouds), mergeOrder(clouds), kOrderField));
  whole->sensorLabel = scan.label;
  return whole;
}

class LidarMerger
{
 public:
  explicit LidarMerger(RecordingHeader header) : header_(std::move(header)) {}

  Observations operator()(const ObservationPtr& observation)
  {
    if (!observation) return release();
    const auto cloud = cloudIn(observation);
    const auto part = cloud ? partOf(cloud->sensorLabel, header_) : std::nullopt;
    if (!part) return {observation};

    Observations results;
    if (scan_ && !awaits(*part, *cloud)) results = release();
    if (!scan_) scan_ = PartialScan{part->whole, cloud->timestamp, {}};
    scan_->parts.resize(header_.lidars.size());
    scan_->parts[part->lidar] = cloud;
    if (scan_->isComplete()) results.push_back(merged(*std::exchange(scan_, std::nullopt)));
    return results;
  }

 private:
  bool awaits(const LidarPart& part, const CObservationPointCloud& cloud) const
  {
    return scan_->label == part.whole && scan_->stamp == cloud.timestamp && !scan_->parts[part.lidar];
  }

  Observations release()
  {
    if (!scan_) return {};
    return {merged(*std::exchange(scan_, std::nullopt))};
  }

  RecordingHeader header_;
  std::optional<PartialScan> scan_;
};
}  // namespace

RawlogOperation mergeLidars(const RecordingHeader& header) { return LidarMerger(header); }

std::vector<std::uint32_t> mergeOrder(const std::vector<CGenericPointsMap::Ptr>& clouds)
{
  const bool ordered =
      std::all_of(clouds.begin(), clouds.end(),
                  [](const auto& cloud) { return cloud->getPointsBufferRef_double_field(kOrderField) != nullptr; });
  if (ordered)
  {
    std::vector<double> places;
    for (const auto& cloud : clouds)
    {
      const auto& order = *cloud->getPointsBufferRef_double_field(kOrderField);
      places.insert(places.end(), order.begin(), order.end());
    }
    return orderBy(places);
  }
  std::vector<std::tuple<float, std::uint8_t, std::uint16_t>> measured;
  for (const auto& cloud : clouds)
  {
    const auto* t = cloud->getPointsBufferRef_float_field("t");
    const auto* sensor_id = cloud->getPointsBufferRef_uint8_field("sensor_id");
    const auto* column = cloud->getPointsBufferRef_uint16_field("column");
    if (!t || !sensor_id || !column)
      throw std::invalid_argument("a cloud lacks t, sensor_id or column: the order of its points is unknown");
    for (std::size_t i = 0; i < cloud->size(); ++i) measured.emplace_back((*t)[i], (*sensor_id)[i], (*column)[i]);
  }
  return orderBy(measured);
}
}  // namespace scanloom
