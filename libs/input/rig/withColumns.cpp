#include "input/rig/withColumns.h"

#include <algorithm>
#include <limits>

namespace scanloom
{
namespace
{
/** The column that begins with the point `first` ends before this one. */
std::size_t endOfColumn(const PointCloud& points, std::size_t first)
{
  std::size_t end = first;
  while (end < points.size() && points.t[end] == points.t[first] && points.sensor_id[end] == points.sensor_id[first] &&
         end - first < std::numeric_limits<std::uint16_t>::max())
    ++end;
  return end;
}
}  // namespace

Scan withColumns(Scan scan)
{
  PointCloud& points = scan.points;
  scan.columns.clear();
  scan.columns_of.assign(1, 0);
  for (std::size_t first = 0; first < points.size();)
  {
    const std::size_t end = endOfColumn(points, first);
    Column column;
    column.stamp = scan.start + Duration{points.t[first]};
    column.first_point = static_cast<std::uint32_t>(first);
    column.count = static_cast<std::uint16_t>(end - first);
    column.measurement_id = static_cast<std::uint16_t>(scan.columns.size());
    column.sensor_id = points.sensor_id[first];
    std::fill(points.column.begin() + first, points.column.begin() + end, column.measurement_id);
    scan.columns.push_back(column);
    if (scan.columns_of.size() <= column.sensor_id) scan.columns_of.resize(column.sensor_id + std::size_t{1});
    ++scan.columns_of[column.sensor_id];
    first = end;
  }
  return scan;
}
}  // namespace scanloom
