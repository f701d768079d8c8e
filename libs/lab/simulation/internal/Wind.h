/** Wind: how far leaves and stems are from where they rest, as a smooth function of place and time. */
#pragma once
#include "base/core/Field.h"
#include "lab/simulation/internal/SineCosine.h"

#include <Eigen/Core>

#include <cstdint>

namespace scanloom
{
struct WindOptions
{
  double speed = 0;
  double direction_deg = 60;  // deg: direction that it blows to, from the x axis
  double gusts = 0.5;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.speed, Field{"speed", "m/s", "mean wind speed at the tree tops; 0: calm, nothing moves", between(0, 25)});
    visit(o.gusts, Field{"gusts", "", "how much the displacement varies in gusts, as a share of its mean (assumed)",
                         between(0, 2)});
  }
};

/** Horizontal displacements, m. */
struct WindShift
{
  Eigen::Vector2d of_wood, of_leaves;
};

/**
 * The displacement is that of what is at a place now: it was at rest at the place minus the displacement. Stems bend
 * with the square of the height, as a cantilever does at first order. All of a stand sway with the frequency of the
 * mean tree. Calm by default.
 */
class Wind
{
 public:
  Wind() = default;

  /** `diameter` and `height` (m) of the mean tree. */
  Wind(const WindOptions&, double diameter, double height, std::uint64_t seed);

  bool isCalm() const { return speed_ == 0; }

  /** At a place `height` m above the ground, `t` s after the start of the recording. Pure. */
  WindShift at(const Eigen::Vector2d& place, double height, double t) const;

 private:
  /** Four travelling waves. */
  struct Waves
  {
    Eigen::Array4d kx, ky;  // rad/m
    Eigen::Array4d rate;    // rad/s
    Eigen::Array4d phase;   // rad
    Eigen::Array4d along;   // amplitude along the wind, as a share
    Eigen::Array4d across;

    /** Along and across the wind. */
    Eigen::Vector2d at(const Eigen::Vector2d& place, double t) const
    {
      const auto wave = sineCosine<4, 11>(kx * place.x() + ky * place.y() - rate * t + phase);
      return {(along * wave.sine).sum(), (across * wave.cosine).sum()};
    }
  };

  double speed_ = 0;      // m/s
  double sway_rate_ = 0;  // Hz
  double height_ = 1;     // m, of the mean tree
  double tip_sway_ = 0;   // m, at this speed
  double leaf_sway_ = 0;  // m, at this speed
  Eigen::Vector2d along_ = Eigen::Vector2d::UnitX(), across_ = Eigen::Vector2d::UnitY();
  Waves stems_, leaves_;
};
}  // namespace scanloom
