#include "input/lidar/internal/BeamTable.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
bool sameOrigin(const Beam& l, const Beam& r) { return l.origin == r.origin && l.range_offset == r.range_offset; }
}  // namespace

BeamTable::BeamTable(const std::vector<Beam>& beams, const Rigid& body_T_lidar)
  : size_(static_cast<Eigen::Index>(beams.size())),
    blocks_((beams.size() + BeamBlock::kBeams - 1) / BeamBlock::kBeams),
    has_one_origin_(
        std::all_of(beams.begin(), beams.end(), [&](const Beam& b) { return sameOrigin(b, beams.front()); }))
{
  constexpr double kMetresPerMillimetre = 1e-3;
  const Eigen::Matrix3d rotation = body_T_lidar.rotation.toRotationMatrix();
  for (std::size_t i = 0; i < beams.size(); ++i)
  {
    const Beam& beam = beams[i];
    const double cos_al = std::cos(beam.altitude);
    const double cos_az = std::cos(beam.azimuth), sin_az = std::sin(beam.azimuth);

    // Direction and origin of the ray are of the form c u + s v + w, since Rz(th) p = c (x, y, 0) + s (-y, x, 0) + (0,
    // 0, z).
    const Eigen::Vector3d u{cos_az * cos_al, sin_az * cos_al, 0}, v{-sin_az * cos_al, cos_az * cos_al, 0};
    const Eigen::Vector3d w{0, 0, std::sin(beam.altitude)};
    const Eigen::Vector3d ou{beam.origin.x(), beam.origin.y(), 0}, ov{-beam.origin.y(), beam.origin.x(), 0};
    const Eigen::Vector3d ow{0, 0, beam.origin.z()};

    BeamBlock& block = blocks_[i / BeamBlock::kBeams];
    const std::size_t lane = i % BeamBlock::kBeams;
    const auto put = [lane](float(&coefficient)[3][BeamBlock::kBeams], const Eigen::Vector3d& value)
    {
      for (int k = 0; k < 3; ++k) coefficient[k][lane] = static_cast<float>(value[k]);
    };
    put(block.a, rotation * (kMetresPerMillimetre * u));
    put(block.b, rotation * (kMetresPerMillimetre * v));
    put(block.c, rotation * (kMetresPerMillimetre * w));
    block.range_offset[lane] = static_cast<float>(beam.range_offset / kMetresPerMillimetre);
    put(block.d, rotation * ou);
    put(block.e, rotation * ov);
    put(block.f, rotation * ow + body_T_lidar.translation);
  }
}

Eigen::Vector3f BeamTable::project(Eigen::Index beam, float cos_th, float sin_th, float range_mm) const
{
  const BeamBlock& block = blocks_[static_cast<std::size_t>(beam) / BeamBlock::kBeams];
  const std::size_t i = static_cast<std::size_t>(beam) % BeamBlock::kBeams;
  const float along = range_mm - block.range_offset[i];
  Eigen::Vector3f point;
  for (int k = 0; k < 3; ++k)
    point[k] = along * (cos_th * block.a[k][i] + sin_th * block.b[k][i] + block.c[k][i]) +
               (cos_th * block.d[k][i] + sin_th * block.e[k][i] + block.f[k][i]);
  return point;
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
