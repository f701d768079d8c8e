/** Geometry of a spinning lidar with the extrinsics folded in: 19 floats per beam, one cosine and sine per block. */
#pragma once
#include "core/Rigid.h"

#include <Eigen/Core>

#include <vector>

namespace scanloom
{
/** One laser, in the frame whose x axis turns with the encoder angle th. Metres and radians. */
struct Beam
{
  double azimuth = 0;                                // of the beam against that x axis, counter-clockwise from above
  double altitude = 0;                               // above the plane of rotation
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // of the ray: turns with th
  double range_offset = 0;                           // the measured range minus the distance from `origin`
};

/** Coefficients of sixteen beams, so that a vector of them is one load; by coordinate, then by beam. */
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
 * is range_offset. A to C hold metres per millimetre, so that the integer range is converted once and without rounding.
 */
class BeamTable
{
 public:
  using Coordinates = Eigen::Array<float, Eigen::Dynamic, 3>;  // beams x (x, y, z), each coordinate contiguous
  using Ranges = Eigen::Array<float, Eigen::Dynamic, 1>;

  BeamTable(const std::vector<Beam>&, const Rigid& body_T_lidar);

  Eigen::Index size() const { return size_; }

  /** One point per beam in the body frame, metres. `range_mm` has size() rows, and so has `points`. */
  void project(float cos_th, float sin_th, const Eigen::Ref<const Ranges>& range_mm,
               Eigen::Ref<Coordinates> points) const;

  /** One beam's point. */
  Eigen::Vector3f project(Eigen::Index beam, float cos_th, float sin_th, float range_mm) const;

  /** All beams start from one point and have one range offset: then D, E, F and n are those of any beam. */
  bool hasOneOrigin() const { return has_one_origin_; }

  /** The last block is filled up with zeros. */
  const BeamBlock* blocks() const { return blocks_.data(); }

 private:
  Eigen::Index size_;
  std::vector<BeamBlock> blocks_;
  bool has_one_origin_;
};

/** Cosine and sine of each column's encoder angle, computed in double. */
struct ColumnAngles
{
  std::vector<float> cosine, sine;
};

/** th = 2 pi (1 - u / columns_per_frame): Ouster turns clockwise seen from above and starts at its connector. */
ColumnAngles clockwiseColumns(int columns_per_frame);
}  // namespace scanloom
