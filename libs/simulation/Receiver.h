/** What a lidar makes of the light that comes back: whether, how strongly, and how exactly it measures. */
#pragma once
#include "lidar/OusterEncoder.h"
#include "simulation/Random.h"
#include "simulation/Ray.h"
#include "simulation/SimulatedLidarOptions.h"

#include <optional>
#include <string>

namespace scanloom
{
/** 1 where half of the returns are lost: falls with the square of the range. */
double signalStrength(double reflectivity, double cosine_incidence, double range, double range_at_ten_percent);

/** Certain to 0.7 of the range where half of the returns are lost, gone at 1.3 of it. */
double chanceOfReturn(double strength);

/** Standard deviation, m. */
double rangeNoise(const RangingOptions&, double strength);

/** What chance does to a return. */
struct Luck
{
  explicit Luck(Random&);

  double noise;      // standard normal
  double detection;  // uniform: the return is lost if its chance is not above
  double shade;      // standard normal: of the surface's reflectivity
};

/** What one ray of a beam met, and the luck of its return. */
struct Echo
{
  std::optional<Hit> hit;
  Luck luck;
};

struct Reception
{
  OusterReading reading;
  std::optional<Surface> surface;  // of the first return, if there is one
};

class Receiver
{
 public:
  /** Ranges of 0 are taken from the data sheet of the product line. `origin_to_axis`, m: ranges count from there. */
  Receiver(RangingOptions, const std::string& product_line, double origin_to_axis);

  const RangingOptions& options() const { return options_; }

  Reception receive(const Echo&) const;

  /** Of a beam that is wide enough to meet two surfaces: if they are far enough apart, each gets half of its light. */
  Reception receive(const Echo& on_axis, const Echo& beside) const;

 private:
  struct Return
  {
    OusterReturn measured;
    Surface surface;
  };
  std::optional<Return> returnOf(const Echo&, double share_of_light) const;
  std::uint16_t nearIrOf(const Echo&) const;
  double reflectivityOf(const Hit&, const Luck&) const;

  RangingOptions options_;
  double origin_to_axis_;  // m
};
}  // namespace scanloom
