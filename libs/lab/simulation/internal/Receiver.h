/** From the light that comes back to a reading: whether there is a return, its strength and its error. */
#pragma once
#include "input/lidar/OusterEncoder.h"
#include "lab/simulation/internal/Precipitation.h"
#include "lab/simulation/internal/Random.h"
#include "lab/simulation/internal/Ray.h"
#include "lab/simulation/internal/SimulatedLidarOptions.h"

#include <optional>
#include <string>

namespace scanloom
{
/** Signal strength; 1 where half of the returns are lost. It falls with the square of the range. */
double signalStrength(double reflectivity, double cosine_incidence, double range, double range_at_ten_percent);

/** Probability of a return: 1 up to 0.7 of the range at which half of the returns are lost, 0 from 1.3 of it on. */
double chanceOfReturn(double strength);

/** Standard deviation of a range, m. */
double rangeNoise(const RangingOptions&, double strength);

/** The random numbers of a return. */
struct Luck
{
  explicit Luck(Random&);

  double noise;      // standard normal
  double detection;  // uniform: the return is lost if this is at least its probability
  double shade;      // standard normal: variation of the surface's reflectivity
};

/** What one ray of a beam met. */
struct Echo
{
  std::optional<Hit> hit;
  Luck luck;
  std::optional<Speck> speck = std::nullopt;  // of rain or snow, on the way to the hit
};

struct Reception
{
  OusterReading reading;
  std::optional<Surface> surface;  // of the first return, if there is one
};

class Receiver
{
 public:
  /** Options of 0 m are taken from the product line's data sheet. `origin_to_axis` (m) is added to every range. */
  Receiver(RangingOptions, const std::string& product_line, double origin_to_axis, const PrecipitationOptions& = {});

  const RangingOptions& options() const { return options_; }
  const Precipitation& precipitation() const { return precipitation_; }

  /** The stronger return of a surface and a drop before it. */
  Reception receive(const Echo&) const;

  /**
   * A beam that may meet two surfaces: if they are at least least_separation apart, each gets half of its light. A drop
   * on the axis is a further return; the two strongest are received.
   */
  Reception receive(const Echo& on_axis, const Echo& beside) const;

 private:
  struct Return
  {
    OusterReturn measured;
    Surface surface;
  };
  std::optional<Return> returnOf(const Echo&, double share_of_light) const;
  std::optional<Return> returnOfSpeck(const Echo&) const;
  Return measured(double range, double strength, double reflectivity, const Luck&, Surface) const;
  static bool isStronger(const Return&, const std::optional<Return>&);
  std::uint16_t nearIrOf(const Echo&) const;
  double reflectivityOf(const Hit&, const Luck&) const;

  RangingOptions options_;
  double origin_to_axis_;  // m
  Precipitation precipitation_;
};
}  // namespace scanloom
