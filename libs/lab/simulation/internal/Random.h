/** Random numbers that depend on their key alone, so that neither threads nor order change them. */
#pragma once
#include <cmath>
#include <cstdint>

namespace scanloom
{
/** What random numbers are drawn for. Never reorder: the values are part of the key. */
enum class RandomStream : std::uint64_t
{
  Stand,
  Lidar,
  LidarTiming,
  Transport,
  LidarImu,
  Boom,
  BoomRate,
  BodyImu,
  Passers,
  FelledTrees,
  ImuBiases,
  TotalStation,
  Work,
  Trees,
  Clusters,
  Branches,
  Foliage,
  Undergrowth,
  Leaves,
  Bursts,
  Beside,
  Wind,
  Precipitation,
  Engine,
  Buildings,
  Gnss,
};

/** SplitMix64 (Steele, Lea, Flood: Fast Splittable Pseudorandom Number Generators, OOPSLA 2014), seeded by a key. */
class Random
{
 public:
  /** `index`: number of the column, sample or stem. */
  Random(std::uint64_t seed, RandomStream stream, std::uint64_t index)
    : state_(mix(mix(mix(seed) + static_cast<std::uint64_t>(stream)) + index))
  {
  }

  /** `who`: number of the lidar, stop or passer-by. */
  Random(std::uint64_t seed, RandomStream stream, std::uint64_t who, std::uint64_t index)
    : state_(mix(mix(mix(mix(seed) + static_cast<std::uint64_t>(stream)) + who) + index))
  {
  }

  std::uint64_t bits() { return mix(state_ += kGoldenGamma); }

  /** In [0, 1). */
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double uniform(double lowest, double highest) { return lowest + (highest - lowest) * uniform(); }

  /** Poisson distributed. */
  int poisson(double mean)
  {
    int events = 0;
    for (double waited = exponential(); waited < mean; waited += exponential()) ++events;
    return events;
  }

  /** Exponentially distributed, mean 1. */
  double exponential() { return -std::log(1 - uniform()); }

  /** Standard normal, by Box and Muller: std::normal_distribution differs between standard libraries. */
  double normal()
  {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * M_PI * uniform());
  }

 private:
  static constexpr std::uint64_t kGoldenGamma = 0x9e3779b97f4a7c15;

  static constexpr std::uint64_t mix(std::uint64_t z)
  {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};
}  // namespace scanloom
