/** Geometry of a spinning lidar with the extrinsics folded in: 18 floats per beam, one cosine and sine per block. */
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

/**
 * With c = cos(th), s = sin(th) and the range r in mm
 *
 *   p_body = r (c A + s B + C) + (c D + s E + F)
 *
 * which is body_T_lidar applied to (r - range_offset) [cos(th+az) cos(al), sin(th+az) cos(al), sin(al)] + Rz(th)
 * origin. A to C hold metres per millimetre, so that the integer range is converted once and without rounding.
 */
class BeamTable
{
 public:
  using Coordinates = Eigen::Array<float, Eigen::Dynamic, 3>;  // beams x (x, y, z), each coordinate contiguous
  using Ranges = Eigen::Array<float, Eigen::Dynamic, 1>;

  BeamTable(const std::vector<Beam>&, const Rigid& body_T_lidar);

  Eigen::Index size() const { return a_.rows(); }

  /** One point per beam in the body frame, metres. `range_mm` has size() rows, and so has `points`. */
  void project(float cos_th, float sin_th, const Eigen::Ref<const Ranges>& range_mm,
               Eigen::Ref<Coordinates> points) const
  {
    for (int k = 0; k < 3; ++k)  // one coordinate at a time: that is how Eigen vectorises it
      points.col(k) = range_mm * (cos_th * a_.col(k) + sin_th * b_.col(k) + c_.col(k)) +
                      (cos_th * d_.col(k) + sin_th * e_.col(k) + f_.col(k));
  }

  /** One beam's point, for sensors whose beams fire one after another and so at an angle each. */
  Eigen::Vector3f project(Eigen::Index beam, float cos_th, float sin_th, float range_mm) const
  {
    return range_mm * (cos_th * a_.row(beam) + sin_th * b_.row(beam) + c_.row(beam)) +
           (cos_th * d_.row(beam) + sin_th * e_.row(beam) + f_.row(beam));
  }

 private:
  Coordinates a_, b_, c_, d_, e_, f_;
};

/** Cosine and sine of each column's encoder angle, computed in double. */
struct ColumnAngles
{
  std::vector<float> cosine, sine;
};

/** th = 2 pi (1 - u / columns_per_frame): Ouster turns clockwise seen from above and starts at its connector. */
ColumnAngles clockwiseColumns(int columns_per_frame);
}  // namespace scanloom
