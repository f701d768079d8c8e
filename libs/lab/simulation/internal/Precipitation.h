/**
 * Rain and snow as a lidar sees them: drops near by that return a beam, and light that is lost on the way.
 *
 * Diameters D (mm) have the density N0 exp(-Lambda D) per m^3 and mm. Rain of R mm/h: N0 = 8000, Lambda = 4.1 R^-0.21
 * (J. S. Marshall and W. McK. Palmer: The Distribution of Raindrops with Size, Journal of Meteorology 5, 1948). Snow:
 * N0 = 3800 R^-0.87, Lambda = 2.55 R^-0.48 of the melted flakes (K. L. S. Gunn and J. S. Marshall: The Distribution
 * with Size of Aggregate Snowflakes, Journal of Meteorology 15, 1958).
 */
#pragma once
#include "base/core/Field.h"
#include "lab/simulation/internal/Random.h"
#include "lab/simulation/internal/SimulatedLidarOptions.h"

#include <optional>
#include <vector>

namespace scanloom
{
struct PrecipitationOptions
{
  double rain = 0;
  double snow = 0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.rain, Field{"rain", "mm/h", "rain; light 2, heavy 10 and more; 0: none", between(0, 100)});
    visit(o.snow, Field{"snow", "mm/h", "snow, as water; 0: none", between(0, 20)});
  }
};

/** A drop or flake that returns a beam. */
struct Speck
{
  double range;     // m
  double strength;  // at least 1, as signalStrength()
};

/** Drops of one kind. A drop returns a beam whose disc it fills by so much that its strength is at least 1. */
class FallingDrops
{
 public:
  /** `per_mm`: N0, `decline`: Lambda. Ranges of RangingOptions as of the data sheet, above 0. */
  FallingDrops(double per_mm, double decline, double reflectivity, double aperture, const RangingOptions&);

  /** Drops per metre of a beam that return it: area of the beam x number per m^3 above the smallest diameter. */
  double returnsPerMetre(double range) const;

  /** 1/m: twice the area of all drops per m^3 (H. C. van de Hulst: Light Scattering by Small Particles, 1957). */
  double extinction() const;

  /** The nearest drop on a beam that returns it, if there is one. Takes two random numbers. */
  std::optional<Speck> draw(Random&) const;

 private:
  double beamDiameter(double range) const { return aperture_ + divergence_ * range; }
  double smallestDiameter(double range) const;  // mm

  double per_mm_, decline_;  // 1/(m3 mm), 1/mm
  double reflectivity_;
  double aperture_, divergence_;  // m, rad
  double least_range_, range_at_ten_percent_;
  std::vector<double> returns_;  // number up to each step of range
};

class Precipitation
{
 public:
  /** None. */
  Precipitation() = default;

  /** Ranges of RangingOptions as of the data sheet, above 0. */
  Precipitation(const PrecipitationOptions&, const RangingOptions&);

  bool isNone() const { return kinds_.empty(); }

  /** The nearest drop or flake on a beam that returns it. Takes the same number of random numbers for each beam. */
  std::optional<Speck> draw(Random&) const;

  /** Share of the light that comes back from a surface at this range. */
  double transmission(double range) const;

 private:
  std::vector<FallingDrops> kinds_;
  double extinction_ = 0;  // 1/m
};
}  // namespace scanloom
