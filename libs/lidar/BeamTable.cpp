#include "lidar/BeamTable.h"

#include <cmath>

namespace scanloom
{
BeamTable::BeamTable(const std::vector<Beam>& beams, const Rigid& body_T_lidar)
{
  const auto count = static_cast<Eigen::Index>(beams.size());
  for (Coordinates* coefficients : {&a_, &b_, &c_, &d_, &e_, &f_}) coefficients->resize(count, 3);

  constexpr double kMetresPerMillimetre = 1e-3;
  const Eigen::Matrix3d rotation = body_T_lidar.rotation.toRotationMatrix();
  for (Eigen::Index i = 0; i < count; ++i)
  {
    const Beam& beam = beams[static_cast<std::size_t>(i)];
    const double cos_al = std::cos(beam.altitude);
    const double cos_az = std::cos(beam.azimuth), sin_az = std::sin(beam.azimuth);

    // The ray's direction and the origin are c u + s v + w each, since Rz(th) p = c (x, y, 0) + s (-y, x, 0) + (0, 0,
    // z).
    const Eigen::Vector3d u{cos_az * cos_al, sin_az * cos_al, 0}, v{-sin_az * cos_al, cos_az * cos_al, 0};
    const Eigen::Vector3d w{0, 0, std::sin(beam.altitude)};
    const Eigen::Vector3d ou{beam.origin.x(), beam.origin.y(), 0}, ov{-beam.origin.y(), beam.origin.x(), 0};
    const Eigen::Vector3d ow{0, 0, beam.origin.z()};

    const auto put = [&](Coordinates& row, const Eigen::Vector3d& value)
    { row.row(i) = (rotation * value).transpose().cast<float>().array(); };
    put(a_, kMetresPerMillimetre * u);
    put(b_, kMetresPerMillimetre * v);
    put(c_, kMetresPerMillimetre * w);
    put(d_, ou - beam.range_offset * u);
    put(e_, ov - beam.range_offset * v);
    f_.row(i) = (rotation * (ow - beam.range_offset * w) + body_T_lidar.translation).transpose().cast<float>().array();
  }
}

ColumnAngles clockwiseColumns(int columns_per_frame)
{
  ColumnAngles angles;
  for (int u = 0; u < columns_per_frame; ++u)
  {
    const double th = 2 * M_PI * (1.0 - static_cast<double>(u) / columns_per_frame);
    angles.cosine.push_back(static_cast<float>(std::cos(th)));
    angles.sine.push_back(static_cast<float>(std::sin(th)));
  }
  return angles;
}
}  // namespace scanloom
