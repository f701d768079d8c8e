#include "lab/simulation/internal/Ground.h"

#include "lab/simulation/internal/SineCosine.h"

#include <algorithm>
#include <limits>

namespace scanloom
{
namespace
{
struct Gap
{
  double size;   // m
  double slope;  // of the size along the ray
};

/** A step within which the gap cannot close if its slope is at most `fastest` and its curvature at most `bend`. */
double safeStep(const Gap& gap, double fastest, double bend)
{
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double by_slope = fastest > 0 ? gap.size / fastest : kNever;
  const double root = std::sqrt(gap.slope * gap.slope + 2 * bend * gap.size);
  const double by_bend = gap.slope < 0 ? 2 * gap.size / (root - gap.slope) : (root + gap.slope) / bend;
  return std::max(by_slope, by_bend);
}
}  // namespace

/** The heights of two waves under a ray, as functions of the range. */
class Ground::WavesAlongRay
{
 public:
  WavesAlongRay(const Waves& waves, const Ray& ray)
  {
    for (int i = 0; i < 2; ++i)
    {
      amplitude_[i] = waves[i].amplitude;
      phase_[i] = waves[i].k.dot(ray.origin.head<2>()) + waves[i].phase;
      rate_[i] = waves[i].k.dot(ray.direction.head<2>());
    }
  }

  /** Subtracts the waves at a place along the ray. */
  Gap under(const Gap& gap, double range) const
  {
    const SineCosine<2> wave = sineCosine<2>(phase_ + range * rate_);
    return {gap.size - (amplitude_ * wave.sine).sum(), gap.slope - (amplitude_ * rate_ * wave.cosine).sum()};
  }

  double steepest() const { return (amplitude_ * rate_.abs()).sum(); }
  double bend() const { return (amplitude_ * rate_.square()).sum(); }

 private:
  Eigen::Array2d amplitude_, phase_, rate_;  // m, rad, rad per metre of ray
};

Ground::Ground(const GroundOptions& options, const SlopeOptions& slopes)
  : long_waves_{{{0.325 * options.relief, {2 * M_PI / 47, 2 * M_PI / 90}, 0.4},
                 {0.175 * options.relief, {-2 * M_PI / 60, 2 * M_PI / 21}, 1.9}}},
    short_waves_{{{0.30 * options.roughness, {2 * M_PI / 4.3, 2 * M_PI / 3.1}, 0.0},
                  {0.20 * options.roughness, {-2 * M_PI / 1.9, 2 * M_PI / 2.7}, 2.7}}},
    highest_(0.5 * (options.relief + options.roughness)),
    short_crest_(0.5 * options.roughness)
{
  if (slopes.grade == 0) return;
  constexpr double kAlong = 0.8, kAcross = 0.6;  // where both are steepest, they are as steep as 'grade'
  // One slope lies along the machine's axis, the other, of 1.4 times its length, across it.
  const double along = 2 * M_PI / slopes.length, across = along / 1.4;
  hills_ =
      Waves{{{kAlong * slopes.grade / along, {along, 0}, 0.0}, {kAcross * slopes.grade / across, {0, across}, 0.6}}};
  for (const Wave& wave : *hills_) highest_ += wave.amplitude;
}

double Ground::smoothHeight(double x, double y) const
{
  double z = 0;
  for (const Waves* waves : {&long_waves_, hills_ ? &*hills_ : nullptr})
    if (waves != nullptr)
    {
      const Wave &first = (*waves)[0], &second = (*waves)[1];
      const Eigen::Array2d angles(first.k.x() * x + first.k.y() * y + first.phase,
                                  second.k.x() * x + second.k.y() * y + second.phase);
      z += (Eigen::Array2d(first.amplitude, second.amplitude) * sineCosine<2, 11>(angles).sine).sum();
    }
  return z;
}

Eigen::Vector3d Ground::normal(double x, double y) const
{
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  for (const Waves* waves : {&long_waves_, &short_waves_})
    for (const Wave& wave : *waves)
      slope += wave.amplitude * std::cos(wave.k.x() * x + wave.k.y() * y + wave.phase) * wave.k;
  if (hills_)
    for (const Wave& wave : *hills_)
      slope += wave.amplitude * std::cos(wave.k.x() * x + wave.k.y() * y + wave.phase) * wave.k;
  return Eigen::Vector3d(-slope.x(), -slope.y(), 1).normalized();
}

std::optional<double> Ground::intersect(const Ray& ray, double max_range) const
{
  constexpr double kExact = 1e-6;      // m
  constexpr double kNearCrest = 1e-3;  // m: from here on the short waves are evaluated, too
  const double descent = -ray.direction.z();
  const double above_highest = ray.origin.z() - highest_;
  if (above_highest > 0 && descent <= 0) return std::nullopt;
  double range = above_highest > 0 ? above_highest / descent : 0.0;

  // First down to the long waves raised by the crests of the short ones, then down to the ground. Slope and curvature
  // of the waves limit each step, so that none can jump over a crest.
  const WavesAlongRay long_waves(long_waves_, ray), short_waves(short_waves_, ray);
  std::optional<WavesAlongRay> hills;
  if (hills_) hills.emplace(*hills_, ray);
  const double fastest_of_long = descent + long_waves.steepest() + (hills ? hills->steepest() : 0);
  const double bend_of_long = long_waves.bend() + (hills ? hills->bend() : 0);
  const double fastest = fastest_of_long + short_waves.steepest(), bend = bend_of_long + short_waves.bend();
  while (range < max_range)
  {
    const double z = ray.origin.z() - range * descent;
    if (descent < 0 && z > highest_) return std::nullopt;
    const Gap over_hills = hills ? hills->under({z, -descent}, range) : Gap{z, -descent};
    const Gap over_long = long_waves.under(over_hills, range);
    const Gap over_crests{over_long.size - short_crest_, over_long.slope};
    if (over_crests.size > kNearCrest)
    {
      range += safeStep(over_crests, fastest_of_long, bend_of_long);
      continue;
    }
    const Gap gap = short_waves.under(over_long, range);
    if (gap.size < kExact) return range;
    range += safeStep(gap, fastest, bend);
  }
  return std::nullopt;
}
}  // namespace scanloom
