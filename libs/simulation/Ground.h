#pragma once
#include "core/Field.h"
#include "simulation/Ray.h"

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <optional>

namespace scanloom
{
struct GroundOptions
{
  double relief = 0.4;
  double roughness = 0.04;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.relief, Field{"relief", "m", "amplitude of the ground's long waves", between(0, 2)});
    visit(o.roughness, Field{"roughness", "m", "amplitude of the ground's short waves", between(0, 0.1)});
  }
};

/** A smooth ground by formula: four waves of different length and direction. */
class Ground
{
 public:
  explicit Ground(const GroundOptions&);

  /** For double, and for Taylor to drive on it. */
  template <typename Scalar>
  Scalar height(const Scalar& x, const Scalar& y) const
  {
    using std::sin;
    Scalar z = 0.0;
    for (const Wave& wave : waves_) z = z + wave.amplitude * sin(wave.k.x() * x + wave.k.y() * y + wave.phase);
    return z;
  }

  /** Upward unit normal. */
  Eigen::Vector3d normal(double x, double y) const;

  /** Where the ray first meets the ground within `max_range`, to 1 um. */
  std::optional<double> intersect(const Ray&, double max_range) const;

 private:
  struct Wave
  {
    double amplitude;   // m
    Eigen::Vector2d k;  // rad/m
    double phase;       // rad
  };

  std::array<Wave, 4> waves_;
  double highest_ = 0;   // m, bound of |height|
  double steepest_ = 0;  // bound of the slope
};
}  // namespace scanloom
