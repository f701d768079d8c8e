#include "lab/simulation/internal/Precipitation.h"
#include "lab/simulation/internal/Receiver.h"
#include "support/with.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scanloom::precipitation_unittest
{
namespace
{
constexpr double kReflectivity = 0.02, kAperture = 0.005;

RangingOptions ofOs0()
{
  return with(&RangingOptions::range_at_ten_percent, 35, with(&RangingOptions::least_range, 0.3));
}

double declineOfRain(double mm_per_hour) { return 4.1 * std::pow(mm_per_hour, -0.21); }

FallingDrops rainOf(double mm_per_hour)
{
  return {8000, declineOfRain(mm_per_hour), kReflectivity, kAperture, ofOs0()};
}

double beamDiameter(double range) { return kAperture + 0.35 * M_PI / 180 * range; }

/** Drops of each diameter in turn, with the strength of a surface that fills a part of the beam. */
double countedReturnsPerMetre(double mm_per_hour, double range)
{
  const double beam = beamDiameter(range), step = 1e-3;
  double drops = 0;  // per m3
  for (double mm = 0.5 * step; mm < 20; mm += step)
  {
    const double share = std::pow(1e-3 * mm / beam, 2);
    if (share * signalStrength(kReflectivity, 1, range, 35) >= 1)
      drops += 8000 * std::exp(-declineOfRain(mm_per_hour) * mm) * step;
  }
  return M_PI_4 * beam * beam * drops;
}

Hit wallAt(double range)
{
  Hit hit;
  hit.range = range;
  hit.cosine_incidence = 1;
  hit.surface = Surface::Stem;
  return hit;
}
}  // namespace

TEST(Precipitation, returnsTheBeamsOfWhichDropsFillEnough)
{
  for (const double range : {0.5, 1.0, 2.0})
  {
    const double expected = countedReturnsPerMetre(10, range);
    EXPECT_NEAR(rainOf(10).returnsPerMetre(range), expected, 0.01 * expected) << range;
  }
  EXPECT_LT(rainOf(10).returnsPerMetre(5), 1e-4 * rainOf(10).returnsPerMetre(1)) << "far drops are too weak";
}

TEST(Precipitation, meetsAsManyBeamsAsAPoissonProcessDoes)
{
  const FallingDrops rain = rainOf(25);
  double events = 0;
  for (double range = 0.3005; range < 1; range += 0.001) events += 0.001 * rain.returnsPerMetre(range);
  Random random(3, RandomStream::Precipitation, 0);
  const int beams = 100'000;
  int returned = 0;
  for (int i = 0; i < beams; ++i)
    if (const auto speck = rain.draw(random))
    {
      EXPECT_GE(speck->strength, 1);
      EXPECT_GE(speck->range, 0.3);
      returned += speck->range < 1;
    }
  const double expected = beams * -std::expm1(-events);
  EXPECT_GT(expected, 1000);
  EXPECT_NEAR(returned, expected, 4 * std::sqrt(expected));
}

/** 1.076 R^0.67 dB/km: T. H. Carbonneau and D. R. Wisely, Proc. SPIE 3232, 1998. */
TEST(Precipitation, takesLightAwayAsLinksThroughRainMeasure)
{
  for (const double mm_per_hour : {5.0, 10.0, 25.0})
  {
    const double decibels = 10 / std::log(10) * 1000 * rainOf(mm_per_hour).extinction();
    const double measured = 1.076 * std::pow(mm_per_hour, 0.67);
    EXPECT_GT(decibels, 0.7 * measured);
    EXPECT_LT(decibels, 1.5 * measured);
  }
}

TEST(Precipitation, ofSnowReturnsMoreBeamsAndShortensTheSightMoreThanRain)
{
  PrecipitationOptions rain, snow;
  rain.rain = 5;
  snow.snow = 5;
  const Precipitation drops(rain, ofOs0()), flakes(snow, ofOs0());
  Random random(4, RandomStream::Precipitation, 0);
  int by_drops = 0, by_flakes = 0;
  for (int i = 0; i < 10'000; ++i)
  {
    by_drops += drops.draw(random).has_value();
    by_flakes += flakes.draw(random).has_value();
  }
  EXPECT_GT(by_flakes, 2 * by_drops);
  EXPECT_LT(flakes.transmission(30), drops.transmission(30));
  EXPECT_LT(drops.transmission(30), 1);
}

TEST(Precipitation, isOffByDefault) { EXPECT_TRUE(Precipitation({}, ofOs0()).isNone()); }

TEST(Precipitation, isReceivedWhereItIsStrongerThanTheSurfaceBehind)
{
  RangingOptions options = ofOs0();
  options.range_noise = options.range_noise_weak = 0;
  Random random(5, RandomStream::Lidar, 0);
  const Receiver receiver(options, "OS0", 0);
  const Luck luck(random);
  const auto rangeOf = [&](const Echo& echo) { return receiver.receive(echo).reading.first.range_mm; };
  const Speck drop{1, 30};
  EXPECT_EQ(rangeOf({std::nullopt, luck, drop}), 1000U) << "before the sky";
  EXPECT_EQ(rangeOf({wallAt(40), luck, drop}), 1000U);
  EXPECT_EQ(rangeOf({wallAt(5), luck, drop}), 5000U);
  EXPECT_EQ(rangeOf({wallAt(0.9), luck, drop}), 900U) << "behind the wall";

  const OusterReading both = receiver.receive({wallAt(5), luck, drop}, {wallAt(5), luck}).reading;
  EXPECT_EQ(both.first.range_mm, 5000U);
  EXPECT_EQ(both.second.range_mm, 1000U);
}

TEST(Precipitation, weakensTheSignalOfASurface)
{
  RangingOptions options = ofOs0();
  options.shade = 0;
  Random random(6, RandomStream::Lidar, 0);
  const Luck luck(random);
  const Receiver dry(options, "OS0", 0), wet(options, "OS0", 0, with(&PrecipitationOptions::snow, 10));
  const double ratio = static_cast<double>(wet.receive({wallAt(15), luck}).reading.first.signal) /
                       dry.receive({wallAt(15), luck}).reading.first.signal;
  EXPECT_NEAR(ratio, wet.precipitation().transmission(15), 0.01);
}
}  // namespace scanloom::precipitation_unittest
