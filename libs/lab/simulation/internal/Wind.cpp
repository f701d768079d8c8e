#include "lab/simulation/internal/Wind.h"

#include "base/core/Angle.h"
#include "lab/simulation/internal/Random.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
// Assumed.
constexpr double kGustLength = 35;  // m: distance from one gust to the next; gusts travel with the wind
constexpr double kTipSway =
    0.3;  // m: mean displacement of the tip of a mean tree in a wind of 10 m/s; it grows with the square of the speed
constexpr double kLeafSway =
    0.03;                          // m: amplitude of leaves on their twigs in a wind of 10 m/s; it grows with the speed
constexpr double kLeafRate = 1.2;  // Hz: frequency of leaves on their twigs

constexpr double kReferenceSpeed = 10;    // m/s, of tip_sway and leaf_sway
constexpr double kFreeHeight = 1;         // m above the ground: lower plants move less
constexpr double kHighestShare = 1.5;     // of the mean tree's height: higher ones bend no further
constexpr double kCentimetres = 100;      // per metre
constexpr double kShortestLeafWave = 12;  // m

/** Natural frequency of stems in Hz (J. Moore and D. Maguire, Trees 18, 2004). */
double swayRateOf(double diameter, double height)
{
  return 0.0948 + 3.4317 * kCentimetres * diameter / (height * height);
}
}  // namespace

Wind::Wind(const WindOptions& options, double diameter, double height, std::uint64_t seed)
  : speed_(options.speed),
    sway_rate_(swayRateOf(diameter, height)),
    height_(height),
    tip_sway_(kTipSway * std::pow(options.speed / kReferenceSpeed, 2)),
    leaf_sway_(kLeafSway * options.speed / kReferenceSpeed)
{
  const double direction = kDegree * options.direction_deg;
  along_ = {std::cos(direction), std::sin(direction)};
  across_ = {-along_.y(), along_.x()};
  Random random(seed, RandomStream::Wind, 0);
  const auto setWave = [&](Waves& waves, int i, double length, double aside, double rate)
  {
    const double bearing = direction + aside;
    waves.kx[i] = 2 * M_PI / length * std::cos(bearing);
    waves.ky[i] = 2 * M_PI / length * std::sin(bearing);
    waves.rate[i] = 2 * M_PI * rate;
    waves.phase[i] = random.uniform(0, 2 * M_PI);
  };
  // Two gusts that the wind carries (G. I. Taylor's frozen turbulence), and two waves of stems at their own frequency.
  const double gust = kGustLength;
  setWave(stems_, 0, gust, 0.0, options.speed / gust);
  setWave(stems_, 1, 0.6 * gust, 0.35, options.speed / (0.6 * gust));
  setWave(stems_, 2, 0.8 * gust, 0.8, 0.94 * sway_rate_);
  setWave(stems_, 3, 0.7 * gust, -0.9, 1.06 * sway_rate_);
  stems_.along = options.gusts * Eigen::Array4d(0.5, 0.3, 0.5, 0.5);
  stems_.across = options.gusts * Eigen::Array4d(0, 0, 0.3, 0.3);
  for (int i = 0; i < 4; ++i)
    setWave(leaves_, i, (1 + 0.25 * i) * kShortestLeafWave, 1.6 * i, (0.8 + 0.25 * i) * kLeafRate);
  leaves_.along = leaves_.across = Eigen::Array4d::Constant(0.5);
}

WindShift Wind::at(const Eigen::Vector2d& place, double height, double t) const
{
  if (height <= 0) return {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  const double share = std::min(height / height_, kHighestShare);
  const Eigen::Vector2d stems = tip_sway_ * share * share * (Eigen::Vector2d(1, 0) + stems_.at(place, t));
  const Eigen::Vector2d twigs = leaf_sway_ * std::min(height / kFreeHeight, 1.0) * leaves_.at(place, t);
  const Eigen::Vector2d leaves = stems + twigs;
  return {stems.x() * along_ + stems.y() * across_, leaves.x() * along_ + leaves.y() * across_};
}
}  // namespace scanloom
