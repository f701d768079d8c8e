#include "simulation/Ground.h"

#include <algorithm>

namespace scanloom
{
Ground::Ground(const GroundOptions& options)
  : waves_{{{0.65 * options.relief, {2 * M_PI / 47, 2 * M_PI / 90}, 0.4},
            {0.35 * options.relief, {-2 * M_PI / 60, 2 * M_PI / 21}, 1.9},
            {0.60 * options.roughness, {2 * M_PI / 4.3, 2 * M_PI / 3.1}, 0.0},
            {0.40 * options.roughness, {-2 * M_PI / 1.9, 2 * M_PI / 2.7}, 2.7}}}
{
  for (const Wave& wave : waves_)
  {
    highest_ += wave.amplitude;
    steepest_ += wave.amplitude * wave.k.norm();
  }
}

Eigen::Vector3d Ground::normal(double x, double y) const
{
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  for (const Wave& wave : waves_)
    slope += wave.amplitude * std::cos(wave.k.x() * x + wave.k.y() * y + wave.phase) * wave.k;
  return Eigen::Vector3d(-slope.x(), -slope.y(), 1).normalized();
}

std::optional<double> Ground::intersect(const Ray& ray, double max_range) const
{
  constexpr double kExact = 1e-6;  // m
  const double descent = -ray.direction.z();
  const double above_highest = ray.origin.z() - highest_;
  if (above_highest > 0 && descent <= 0) return std::nullopt;
  double range = above_highest > 0 ? above_highest / descent : 0.0;

  // The gap closes at most this fast along the ray, so no step can jump over a crest.
  const double fastest = descent + steepest_ * ray.direction.head<2>().norm();
  if (fastest <= 0) return std::nullopt;
  while (range < max_range)
  {
    const Eigen::Vector3d p = ray.at(range);
    const double gap = p.z() - height(p.x(), p.y());
    if (gap < kExact) return range;
    if (descent < 0 && p.z() > highest_) return std::nullopt;
    range += gap / fastest;
  }
  return std::nullopt;
}
}  // namespace scanloom
