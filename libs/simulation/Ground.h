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
  double relief = 1.5;
  double roughness = 0.08;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.relief, Field{"relief", "m", "of the ground's long waves, from hollow to crest", between(0, 4)});
    visit(o.roughness, Field{"roughness", "m", "of the ground's short waves, from hollow to crest", between(0, 0.2)});
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
    for (const Waves* waves : {&long_waves_, &short_waves_})
      for (const Wave& wave : *waves) z = z + wave.amplitude * sin(wave.k.x() * x + wave.k.y() * y + wave.phase);
    return z;
  }

  /** No place is higher, none lower than the negative of it. */
  double highest() const { return highest_; }

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
  using Waves = std::array<Wave, 2>;
  class WavesAlongRay;

  Waves long_waves_, short_waves_;
  double highest_ = 0;      // m, bound of |height|
  double short_crest_ = 0;  // m, bound of the short waves alone
};
}  // namespace scanloom
