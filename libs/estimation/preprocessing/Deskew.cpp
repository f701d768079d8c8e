#include "estimation/preprocessing/Deskew.h"

#include "base/core/forAll.h"

#include <stdexcept>

namespace scanloom
{
namespace
{
void requirePointsOneAfterTheOther(const Scan& scan)
{
  std::size_t next = 0;
  for (const Column& column : scan.columns)
  {
    if (column.first_point != next) throw std::invalid_argument("deskew: the columns do not cover the points");
    next += column.count;
  }
  if (next != scan.points.size()) throw std::invalid_argument("deskew: the columns do not cover the points");
}

void move(const Column& column, const Rigid& reference_T_column, PointCloud& points)
{
  const Eigen::Matrix3f rotation = reference_T_column.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f translation = reference_T_column.translation.cast<float>();
  for (std::size_t i = column.first_point; i < std::size_t{column.first_point} + column.count; ++i)
  {
    const Eigen::Vector3f p = rotation * points.position(i) + translation;
    points.x[i] = p.x();
    points.y[i] = p.y();
    points.z[i] = p.z();
  }
}
}  // namespace

PointCloud deskew(Scan scan, const std::vector<Rigid>& reference_T_column)
{
  if (reference_T_column.size() != scan.columns.size())
    throw std::invalid_argument("deskew: one pose per column is needed");
  requirePointsOneAfterTheOther(scan);
  constexpr std::size_t kGrain = 256;  // columns, about 50 us
  forAll(scan.columns.size(), kGrain,
         [&](std::size_t c) { move(scan.columns[c], reference_T_column[c], scan.points); });
  return std::move(scan.points);
}
}  // namespace scanloom
