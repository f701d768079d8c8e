#include "lab/simulation/internal/Receiver.h"

#include "lab/simulation/internal/AssumedOuster.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
// Assumed.
constexpr double kLeastSeparation = 0.5;  // m: smallest distance of two returns of a beam; nearer ones are one
constexpr double kPhotons = 25;           // signal in photons where half of the returns are lost
constexpr double kSunlight = 1200;        // near infrared photons from a white surface under trees
constexpr double kSkyLight = 900;         // near infrared photons from the sky

constexpr double kRangeStep = 1e-3;  // m, in packets

/** A unit without a product line counts as an OS1, as in parseOusterMetadata. */
RangingOptions ofDataSheet(RangingOptions ranging, std::string product_line)
{
  if (product_line.empty()) product_line = "OS1";
  const OusterFamily& family = ousterFamily(product_line);
  if (ranging.range_at_ten_percent == 0) ranging.range_at_ten_percent = family.range_at_ten_percent;
  if (ranging.least_range == 0) ranging.least_range = family.least_range;
  return ranging;
}

std::uint16_t photons(double count) { return static_cast<std::uint16_t>(std::clamp(count, 1.0, 65535.0)); }

double reflectivityOfSurface(const ReflectivityOptions& options, Surface surface)
{
  switch (surface)
  {
    case Surface::Ground:
      return options.ground;
    case Surface::Stem:
      return options.stem;
    case Surface::Branch:
      return options.branch;
    case Surface::Crown:
      return options.crown;
    case Surface::Undergrowth:
      return options.undergrowth;
    case Surface::Machine:
    case Surface::Boom:
      return options.machine;
    case Surface::Object:
      return options.object;
    case Surface::Building:
      return options.building;
    case Surface::Precipitation:
      return 0;  // a speck has a strength of its own
  }
  return 0;
}
}  // namespace

double signalStrength(double reflectivity, double cosine_incidence, double range, double range_at_ten_percent)
{
  const double reach = range_at_ten_percent / range;
  return reflectivity / 0.10 * cosine_incidence * reach * reach;
}

double chanceOfReturn(double strength) { return std::clamp((1.3 - 1 / std::sqrt(strength)) / 0.6, 0.0, 1.0); }

double rangeNoise(const RangingOptions& ranging, double strength)
{
  return std::hypot(ranging.range_noise, ranging.range_noise_weak / std::sqrt(strength));
}

Luck::Luck(Random& random) : noise(random.normal()), detection(random.uniform()), shade(random.normal()) {}

Receiver::Receiver(RangingOptions options, const std::string& product_line, double origin_to_axis,
                   const PrecipitationOptions& precipitation)
  : options_(ofDataSheet(options, product_line)),
    origin_to_axis_(origin_to_axis),
    precipitation_(precipitation, options_)
{
}

Reception Receiver::receive(const Echo& echo) const
{
  Reception reception;
  reception.reading.near_ir = nearIrOf(echo);
  auto only = returnOf(echo, 1);
  if (const auto speck = returnOfSpeck(echo); speck && isStronger(*speck, only)) only = speck;
  if (only)
  {
    reception.reading.first = only->measured;
    reception.surface = only->surface;
  }
  return reception;
}

Reception Receiver::receive(const Echo& on_axis, const Echo& beside) const
{
  const bool apart = on_axis.hit && beside.hit && std::abs(on_axis.hit->range - beside.hit->range) >= kLeastSeparation;
  if (!apart && !on_axis.speck) return receive(on_axis);

  auto stronger = returnOf(on_axis, apart ? 0.5 : 1), weaker = apart ? returnOf(beside, 0.5) : std::nullopt;
  if (weaker && isStronger(*weaker, stronger)) std::swap(stronger, weaker);
  if (auto speck = returnOfSpeck(on_axis))
  {
    if (isStronger(*speck, stronger)) std::swap(stronger, speck);
    if (speck && isStronger(*speck, weaker)) std::swap(weaker, speck);
  }
  Reception reception;
  reception.reading.near_ir = nearIrOf(on_axis);
  if (stronger)
  {
    reception.reading.first = stronger->measured;
    reception.surface = stronger->surface;
  }
  if (weaker) reception.reading.second = weaker->measured;
  return reception;
}

std::optional<Receiver::Return> Receiver::returnOf(const Echo& echo, double share_of_light) const
{
  if (!echo.hit || echo.hit->range < options_.least_range) return std::nullopt;
  const Hit& hit = *echo.hit;
  const double reflectivity = reflectivityOf(hit, echo.luck);
  double strength =
      share_of_light * signalStrength(reflectivity, hit.cosine_incidence, hit.range, options_.range_at_ten_percent);
  if (!precipitation_.isNone()) strength *= precipitation_.transmission(hit.range);
  if (echo.luck.detection >= chanceOfReturn(strength)) return std::nullopt;
  return measured(hit.range, strength, reflectivity, echo.luck, hit.surface);
}

std::optional<Receiver::Return> Receiver::returnOfSpeck(const Echo& echo) const
{
  if (!echo.speck || (echo.hit && echo.hit->range < echo.speck->range)) return std::nullopt;
  const auto [range, strength] = *echo.speck;
  // The lidar takes it for a surface that fills the beam.
  const double reflectivity = 0.10 * strength * std::pow(range / options_.range_at_ten_percent, 2);
  return measured(range, strength, reflectivity, echo.luck, Surface::Precipitation);
}

Receiver::Return Receiver::measured(double true_range, double strength, double reflectivity, const Luck& luck,
                                    Surface surface) const
{
  const double range = true_range + rangeNoise(options_, strength) * luck.noise + origin_to_axis_;
  OusterReturn measured;
  measured.range_mm = static_cast<std::uint32_t>(std::lround(std::max(range, kRangeStep) / kRangeStep));
  measured.reflectivity = static_cast<std::uint8_t>(std::clamp(100 * reflectivity, 1.0, 100.0));
  measured.signal = photons(kPhotons * strength);
  return {measured, surface};
}

bool Receiver::isStronger(const Return& a, const std::optional<Return>& b)
{
  return !b || a.measured.signal > b->measured.signal;
}

std::uint16_t Receiver::nearIrOf(const Echo& echo) const
{
  const double sunlight = echo.hit ? kSunlight * reflectivityOf(*echo.hit, echo.luck) : kSkyLight;
  return photons(sunlight * (1 + options_.shade * echo.luck.shade));
}

double Receiver::reflectivityOf(const Hit& hit, const Luck& luck) const
{
  constexpr double kDarkest = 0.01;
  return std::max(kDarkest,
                  reflectivityOfSurface(options_.reflectivity, hit.surface) * (1 + options_.shade * luck.shade));
}
}  // namespace scanloom
