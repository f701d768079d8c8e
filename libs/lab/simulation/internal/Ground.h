#pragma once
#include "base/core/Field.h"
#include "lab/simulation/internal/Ray.h"

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
    visit(o.relief,
          Field{"relief", "m", "height difference of the ground's long waves, from hollow to crest", between(0, 4)});
    visit(o.roughness, Field{"roughness", "m", "height difference of the ground's short waves, from hollow to crest",
                             between(0, 0.2)});
  }
};

/** Slopes on which the machine drives up and down. They are added to the waves of GroundOptions. */
struct SlopeOptions
{
  double grade = 0;
  double length = 120;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.grade, Field{"grade", "", "steepest grade of the slopes, 0.2 is 20 %; 0: none", between(0, 0.4)});
    visit(o.length, Field{"length", "m", "distance from one crest to the next along the machine's axis (assumed)",
                          between(30, 1000)});
  }
};

/** Smooth ground: the sum of four sine waves of different length and direction, and of two more on slopes. */
class Ground
{
 public:
  explicit Ground(const GroundOptions&, const SlopeOptions& = {});

  /** Height at (x, y), m. `Scalar` is double, or Taylor for its derivatives along a path. */
  template <typename Scalar>
  Scalar height(const Scalar& x, const Scalar& y) const
  {
    using std::sin;
    Scalar z = 0.0;
    for (const Waves* waves : {&long_waves_, &short_waves_})
      for (const Wave& wave : *waves) z = z + wave.amplitude * sin(wave.k.x() * x + wave.k.y() * y + wave.phase);
    if (hills_)
      for (const Wave& wave : *hills_) z = z + wave.amplitude * sin(wave.k.x() * x + wave.k.y() * y + wave.phase);
    return z;
  }

  /** Height without the short waves, to 1 um; in less time than height(). */
  double smoothHeight(double x, double y) const;

  /** Upper bound of the height, m; its negative is a lower bound. */
  double highest() const { return highest_; }

  /** Upward unit normal. */
  Eigen::Vector3d normal(double x, double y) const;

  /** Range at which the ray first meets the ground, to 1 um; nothing if that is beyond `max_range`. */
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
  std::optional<Waves> hills_;
  double highest_ = 0;      // m, bound of |height|
  double short_crest_ = 0;  // m, bound of the short waves alone
};
}  // namespace scanloom
