/** From ranges to points in the body frame: a table of 19 floats per beam, with the extrinsics already applied. */
#pragma once
#include "base/core/Rigid.h"

#include <Eigen/Core>

#include <vector>

namespace scanloom
{
/** One laser, in a frame whose x axis turns with the encoder angle th. Metres and radians. */
struct Beam
{
  double azimuth = 0;                                // from that x axis, counter-clockwise seen from above
  double altitude = 0;                               // angle above the plane of rotation
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // of the ray, in the turning frame
  double range_offset = 0;                           // the measured range minus the distance from `origin`
};

/** Coefficients of sixteen beams, by coordinate, then by beam: a vector register of them is one load. */
struct alignas(64) BeamBlock
{
  static constexpr std::size_t kBeams = 16;
  float a[3][kBeams], b[3][kBeams], c[3][kBeams];  // metres per millimetre
  float range_offset[kBeams];                      // mm
  float d[3][kBeams], e[3][kBeams], f[3][kBeams];  // m
};

/**
 * With c = cos(th), s = sin(th) and the range r in mm
 *
 *   p_body = (r - n) (c A + s B + C) + (c D + s E + F)
 *
 * which is body_T_lidar applied to (r - n) [cos(th+az) cos(al), sin(th+az) cos(al), sin(al)] + Rz(th) origin, where n
 * is range_offset. A to C are in metres per millimetre: the integer range in mm needs no conversion to metres.
 */
class BeamTable
{
 public:
  BeamTable(const std::vector<Beam>&, const Rigid& body_T_lidar);

  Eigen::Index size() const { return size_; }

  /** The point that one beam measured, in the body frame, m. */
  Eigen::Vector3f project(Eigen::Index beam, float cos_th, float sin_th, float range_mm) const;

  /** Whether all beams have the same origin and range offset, and so the same D, E, F and n. */
  bool hasOneOrigin() const { return has_one_origin_; }

  /** The last block is padded with zeros. */
  const BeamBlock* blocks() const { return blocks_.data(); }

 private:
  Eigen::Index size_;
  std::vector<BeamBlock> blocks_;
  bool has_one_origin_;
};

/** Cosine and sine of each column's encoder angle, computed in double precision. */
struct ColumnAngles
{
  std::vector<float> cosine, sine;
};

/** th = 2 pi (1 - u / columns_per_frame) for column u: clockwise seen from above. */
ColumnAngles clockwiseColumns(int columns_per_frame);
}  // namespace scanloom
