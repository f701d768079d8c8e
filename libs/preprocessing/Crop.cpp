#include "preprocessing/Crop.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
/** Boxes by lidar, as the inner loop asks for them. */
class Fates
{
 public:
  Fates(const CropOptions& options, const std::vector<LidarBox>& lidar_boxes)
    : machine_(Eigen::Vector3d(options.min_x, options.min_y, options.min_z),
               Eigen::Vector3d(options.max_x, options.max_y, options.max_z)),
      lidar_boxes_(lidar_boxes),
      min_range_(options.min_range),
      max_range_(options.max_range)
  {
  }

  std::uint64_t CropCounts::*of(const PointCloud& points, std::size_t i) const
  {
    const Eigen::Vector3d p(points.x[i], points.y[i], points.z[i]);
    if (!p.allFinite()) return &CropCounts::not_finite;
    if (machine_.contains(p)) return &CropCounts::machine;
    for (const LidarBox& own : lidar_boxes_)
      if (own.sensor_id == points.sensor_id[i] && own.box.contains(own.sensor_T_body * p))
        return &CropCounts::lidar_box;
    const double range = 1e-3 * points.range[i];
    if (range != 0 && range < min_range_) return &CropCounts::too_near;
    return range > max_range_ ? &CropCounts::too_far : &CropCounts::kept;
  }

 private:
  Eigen::AlignedBox3d machine_;
  const std::vector<LidarBox>& lidar_boxes_;
  double min_range_, max_range_;
};
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

CroppedScan cropOut(Scan scan, const CropOptions& options, const std::vector<LidarBox>& lidar_boxes)
{
  const Fates fates(options, lidar_boxes);
  CroppedScan cropped;
  std::vector<std::uint8_t> keep(scan.points.size());
  std::uint32_t kept = 0;
  for (Column& column : scan.columns)
  {
    if (column.sensor_id >= cropped.counts.size()) cropped.counts.resize(column.sensor_id + std::size_t{1});
    CropCounts& counts = cropped.counts[column.sensor_id];
    const std::uint32_t first = kept;
    for (std::size_t i = column.first_point; i < std::size_t{column.first_point} + column.count; ++i)
    {
      const auto fate = fates.of(scan.points, i);
      ++(counts.*fate);
      kept += keep[i] = fate == &CropCounts::kept;
    }
    column.first_point = first;
    column.count = static_cast<std::uint16_t>(kept - first);
  }
  scan.points.keep(keep);
  cropped.scan = std::move(scan);
  return cropped;
}
}  // namespace scanloom
