#include "lab/simulation/internal/Precipitation.h"

#include "base/core/Angle.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
// Assumed.
constexpr double kDropReflectivity = 0.02;  // reflectivity of a drop of water over its disc
constexpr double kFlakeReflectivity = 0.5;  // reflectivity of a snowflake
constexpr double kFlakeDensity = 0.1;       // density of a snowflake as a share of that of water
constexpr double kAperture = 0.005;         // m: diameter of a beam where it leaves the lidar

constexpr double kMillimetres = 1e3;  // per metre
constexpr double kStep = 0.02;        // m of range, of the table
constexpr double kFarthestDrop = 20;  // m: farther drops are too weak
}  // namespace

FallingDrops::FallingDrops(double per_mm, double decline, double reflectivity, double aperture,
                           const RangingOptions& ranging)
  : per_mm_(per_mm),
    decline_(decline),
    reflectivity_(reflectivity),
    aperture_(aperture),
    divergence_(kDegree * kBeamDivergenceDeg),
    least_range_(ranging.least_range),
    range_at_ten_percent_(ranging.range_at_ten_percent)
{
  double sum = 0;
  for (double range = least_range_ + 0.5 * kStep; range < std::min(kFarthestDrop, ranging.farthest_range);
       range += kStep)
    returns_.push_back(sum += kStep * returnsPerMetre(range));
}

/** (D / beam diameter)^2 x reflectivity / 10 % x (range_at_ten_percent / range)^2 = 1 */
double FallingDrops::smallestDiameter(double range) const
{
  return kMillimetres * beamDiameter(range) * range / range_at_ten_percent_ / std::sqrt(reflectivity_ / 0.10);
}

double FallingDrops::returnsPerMetre(double range) const
{
  const double area = M_PI_4 * beamDiameter(range) * beamDiameter(range);
  return area * per_mm_ / decline_ * std::exp(-decline_ * smallestDiameter(range));
}

double FallingDrops::extinction() const
{
  const double area = M_PI_4 * per_mm_ * 2 / std::pow(decline_, 3);  // mm2 per m3: integral of D^2 N0 exp(-Lambda D)
  return 2 * area / (kMillimetres * kMillimetres);
}

std::optional<Speck> FallingDrops::draw(Random& random) const
{
  // The first event of a Poisson process comes where its integral reaches an exponentially distributed number.
  const double first = random.exponential(), beyond_smallest = random.exponential() / decline_;
  const auto step = std::lower_bound(returns_.begin(), returns_.end(), first);
  if (step == returns_.end()) return std::nullopt;
  const double before = step == returns_.begin() ? 0 : *(step - 1);
  const double share = (first - before) / (*step - before);
  const double range = least_range_ + kStep * (static_cast<double>(step - returns_.begin()) + share);
  const double smallest = smallestDiameter(range);
  return Speck{range, std::pow((smallest + beyond_smallest) / smallest, 2)};
}

Precipitation::Precipitation(const PrecipitationOptions& options, const RangingOptions& ranging)
{
  if (options.rain > 0)
    kinds_.emplace_back(8000, 4.1 * std::pow(options.rain, -0.21), kDropReflectivity, kAperture, ranging);
  if (options.snow > 0)
  {
    // A flake is wider than the drop that it melts to.
    const double wider = std::cbrt(1 / kFlakeDensity);
    kinds_.emplace_back(3800 * std::pow(options.snow, -0.87) / wider, 2.55 * std::pow(options.snow, -0.48) / wider,
                        kFlakeReflectivity, kAperture, ranging);
  }
  for (const FallingDrops& kind : kinds_) extinction_ += kind.extinction();
}

std::optional<Speck> Precipitation::draw(Random& random) const
{
  std::optional<Speck> nearest;
  for (const FallingDrops& kind : kinds_)
    if (const auto speck = kind.draw(random); speck && (!nearest || speck->range < nearest->range)) nearest = speck;
  return nearest;
}

double Precipitation::transmission(double range) const { return std::exp(-2 * extinction_ * range); }
}  // namespace scanloom
