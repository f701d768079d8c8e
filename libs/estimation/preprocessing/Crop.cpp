#include "estimation/preprocessing/Crop.h"

#include "base/core/forAll.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
/** What removes the point, or `kept`. */
std::uint64_t CropCounts::*fateOf(const PointCloud& points, std::size_t i, const Crop& crop)
{
  const Eigen::Vector3d p(points.x[i], points.y[i], points.z[i]);
  if (!p.allFinite()) return &CropCounts::not_finite;
  if (crop.machine.contains(p)) return &CropCounts::machine;
  for (const LidarBox& own : crop.lidar_boxes)
    if (own.sensor_id == points.sensor_id[i] && own.box.contains(own.sensor_T_body * p)) return &CropCounts::lidar_box;
  const double range = 1e-3 * points.range[i];
  if (range != 0 && range < crop.min_range) return &CropCounts::too_near;
  return range > crop.max_range ? &CropCounts::too_far : &CropCounts::kept;
}

/** Marks the column's points that are kept. */
CropCounts fatesOf(const Column& column, const PointCloud& points, const Crop& crop, std::vector<std::uint8_t>& keep)
{
  CropCounts counts;
  for (std::size_t i = column.first_point; i < std::size_t{column.first_point} + column.count; ++i)
  {
    const auto fate = fateOf(points, i, crop);
    ++(counts.*fate);
    keep[i] = fate == &CropCounts::kept;
  }
  return counts;
}
}  // namespace

std::uint64_t CropCounts::all() const
{
  std::uint64_t sum = 0;
  forEach([&](const char*, auto fate) { sum += this->*fate; });
  return sum;
}

CropCounts& CropCounts::operator+=(const CropCounts& other)
{
  forEach([&](const char*, auto fate) { this->*fate += other.*fate; });
  return *this;
}

Crop cropOf(const CropOptions& o, const std::vector<MountedLidar>& lidars)
{
  return {{Eigen::Vector3d(o.min_x, o.min_y, o.min_z), Eigen::Vector3d(o.max_x, o.max_y, o.max_z)},
          lidarBoxes(o.lidar_boxes, lidars),
          o.min_range,
          o.max_range};
}

bool removes(const Crop& crop, const PointCloud& points, std::size_t i)
{
  return fateOf(points, i, crop) != &CropCounts::kept;
}

CroppedScan cropOut(Scan scan, const Crop& crop)
{
  constexpr std::size_t kGrain = 128;  // columns, about 50 us
  std::vector<CropCounts> fates(scan.columns.size());
  std::vector<std::uint8_t> keep(scan.points.size());
  forAll(scan.columns.size(), kGrain,
         [&](std::size_t c) { fates[c] = fatesOf(scan.columns[c], scan.points, crop, keep); });
  CroppedScan cropped;
  std::uint32_t kept = 0;
  for (std::size_t c = 0; c < scan.columns.size(); ++c)
  {
    Column& column = scan.columns[c];
    if (column.sensor_id >= cropped.counts.size()) cropped.counts.resize(column.sensor_id + std::size_t{1});
    cropped.counts[column.sensor_id] += fates[c];
    column.first_point = kept;
    column.count = static_cast<std::uint16_t>(fates[c].kept);
    kept += column.count;
  }
  scan.points.keep(keep);
  cropped.scan = std::move(scan);
  return cropped;
}
}  // namespace scanloom
