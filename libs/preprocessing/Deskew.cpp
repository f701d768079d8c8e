#include "preprocessing/Deskew.h"

#include <stdexcept>

namespace scanloom
{
PointCloud deskew(Scan scan, const std::vector<Rigid>& reference_T_column)
{
  if (reference_T_column.size() != scan.columns.size())
    throw std::invalid_argument("deskew: one pose per column is needed");

  PointCloud& points = scan.points;
  std::size_t next = 0;
  for (std::size_t c = 0; c < scan.columns.size(); ++c)
  {
    const Column& column = scan.columns[c];
    if (column.first_point != next || next + column.count > points.size())
      throw std::invalid_argument("deskew: the columns do not cover the points");
    const Eigen::Matrix3f rotation = reference_T_column[c].rotation.toRotationMatrix().cast<float>();
    const Eigen::Vector3f translation = reference_T_column[c].translation.cast<float>();
    for (const std::size_t end = next + column.count; next < end; ++next)
    {
      const Eigen::Vector3f p = rotation * points.position(next) + translation;
      points.x[next] = p.x();
      points.y[next] = p.y();
      points.z[next] = p.z();
    }
  }
  if (next != points.size()) throw std::invalid_argument("deskew: the columns do not cover the points");
  return std::move(scan.points);
}
}  // namespace scanloom
