#include "input/batching/Scan.h"

namespace scanloom
{
Scan copyOf(const ScanSlice& slice)
{
  Scan copy;
  copy.start = slice.begin();
  copy.period = slice.end() - slice.begin();
  copy.missing = slice.scan.missing;
  copy.columns_of.assign(slice.scan.columns_of.size(), 0);
  const auto t = static_cast<std::int32_t>((slice.scan.start - copy.start).count());
  for (std::size_t i = slice.first_column; i < slice.end_column; ++i)
  {
    Column column = slice.scan.columns[i];
    const std::size_t first = column.first_point;
    column.first_point = static_cast<std::uint32_t>(copy.points.size());
    for (std::size_t p = first; p < first + column.count; ++p) copy.points.append(slice.scan.points, p);
    ++copy.columns_of[column.sensor_id];
    copy.columns.push_back(column);
  }
  for (std::int32_t& point_t : copy.points.t) point_t += t;
  return copy;
}
}  // namespace scanloom
