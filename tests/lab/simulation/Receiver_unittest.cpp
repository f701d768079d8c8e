#include "lab/simulation/internal/Receiver.h"

#include "input/lidar/OusterDecoder.h"
#include "lab/simulation/internal/ScenePackets.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scanloom::receiver_unittest
{
namespace
{
constexpr double kToAxis = 0.03;  // m

Hit wallAt(double range)
{
  Hit hit;
  hit.range = range;
  hit.cosine_incidence = 1;
  hit.surface = Surface::Stem;
  return hit;
}

RangingOptions plain()
{
  RangingOptions options;
  options.range_at_ten_percent = 20;
  options.least_range = 0.3;
  options.reflectivity.stem = 0.1;
  options.shade = 0;
  return options;
}

struct Statistics
{
  double share = 0, bias = 0, deviation = 0, signal = 0;
};

/** Of many beams that meet the same wall. */
Statistics seenAt(double range, const RangingOptions& options)
{
  const Receiver receiver(options, "OS0", kToAxis);
  Random random(1, RandomStream::Lidar, 0);
  const double kBeams = 40'000;
  double returns = 0, sum = 0, squares = 0, signal = 0;
  for (int i = 0; i < kBeams; ++i)
  {
    const OusterReturn first = receiver.receive({wallAt(range), Luck(random)}).reading.first;
    if (first.range_mm == 0) continue;
    const double error = 1e-3 * first.range_mm - kToAxis - range;
    ++returns, sum += error, squares += error * error, signal += first.signal;
  }
  const double mean = sum / returns;
  return {returns / kBeams, mean, std::sqrt(squares / returns - mean * mean), signal / returns};
}
}  // namespace

TEST(Receiver, losesHalfOfTheReturnsOfTenPercentAtTheRangeThatItIsTold)
{
  EXPECT_NEAR(seenAt(0.7 * 20 - 0.01, plain()).share, 1, 1e-12);
  EXPECT_NEAR(seenAt(20, plain()).share, 0.5, 0.01);
  EXPECT_NEAR(seenAt(1.15 * 20, plain()).share, 0.25, 0.01);
  EXPECT_NEAR(seenAt(1.31 * 20, plain()).share, 0, 1e-12);
}

TEST(Receiver, measuresTheLessExactlyTheLessLightComesBack)
{
  for (const double range : {2.0, 10.0, 20.0})
  {
    const Statistics seen = seenAt(range, plain());
    // Light falls with the square of the range, the noise of weak light with the root of the light.
    const double expected = std::hypot(plain().range_noise, plain().range_noise_weak * range / 20);
    EXPECT_NEAR(seen.deviation, std::hypot(expected, 1e-3 / std::sqrt(12)), 0.02 * expected) << range;
    EXPECT_NEAR(seen.bias, 0, 2e-4) << range;
  }
  EXPECT_NEAR(seenAt(10, plain()).signal / seenAt(5, plain()).signal, 0.25, 0.01);
}

TEST(Receiver, seesNothingThatIsTooNear)
{
  Random random(1, RandomStream::Lidar, 0);
  const Receiver receiver(plain(), "OS0", kToAxis);
  EXPECT_EQ(receiver.receive({wallAt(0.29), Luck(random)}).reading.first.range_mm, 0U);
  EXPECT_NE(receiver.receive({wallAt(0.31), Luck(random)}).reading.first.range_mm, 0U);
}

TEST(Receiver, returnsTheStrongerOfTwoSurfacesFirst)
{
  Random random(1, RandomStream::Lidar, 0);
  RangingOptions exact = plain();
  exact.range_noise = exact.range_noise_weak = 0;
  const Receiver receiver(exact, "OS0", kToAxis);
  const Echo near{wallAt(3), Luck(random)}, far{wallAt(5), Luck(random)}, same{wallAt(3.2), Luck(random)};

  for (const OusterReading& reading : {receiver.receive(near, far).reading, receiver.receive(far, near).reading})
  {
    EXPECT_EQ(reading.first.range_mm, 3030U);
    EXPECT_EQ(reading.second.range_mm, 5030U);
    EXPECT_GT(reading.first.signal, reading.second.signal);
    EXPECT_EQ(reading.first.signal, receiver.receive(near).reading.first.signal / 2) << "half of the light";
  }
  EXPECT_EQ(receiver.receive(near, same).reading.second.range_mm, 0U) << "nearer together than the lidar can tell";
  EXPECT_EQ(receiver.receive(near, {std::nullopt, Luck(random)}).reading.second.range_mm, 0U);
}

TEST(SimulatedLidar, ofAProfileWithTwoReturnsSeesBehindTheEdgesOfThings)
{
  SimulationSettings settings;
  settings.drive.route = "work";
  settings.drive.speed_up = 1;
  settings.drive.duration = 0.2;
  settings.lidars.resize(1);
  settings.lidars[0].model = "OS0-32";
  settings.lidars[0].profile = "RNG19_RFL8_SIG16_NIR16_DUAL";
  const Scene scene = makeScene(settings, 1);
  const OusterDecoder decoder(scene.lidars[0].metadata(), scene.lidars[0].written_body_T_sensor);
  const OusterLayout& layout = decoder.layout();
  ScenePackets packets(scene);
  double beams = 0, seconds = 0, without_first = 0, close = 0;
  for (Datagram datagram; packets.next(datagram);)
  {
    if (datagram.destination_port != decoder.description().lidar_port) continue;
    for (int column = 0; column < scene.lidars[0].metadata().columns_per_packet; ++column)
      for (int beam = 0; beam < 32; ++beam)
      {
        const std::size_t at = layout.columnOffset(column) + layout.columnHeaderBytes() +
                               static_cast<std::size_t>(beam) * 16;  // RNG19 dual: four words, ranges in the first two
        const std::uint32_t first = load<std::uint32_t>(datagram.payload, at) & 0x7ffff;
        const std::uint32_t second = load<std::uint32_t>(datagram.payload, at + 4) & 0x7ffff;
        ++beams;
        if (second == 0) continue;
        ++seconds;
        if (first == 0) ++without_first;
        if (std::abs(static_cast<double>(first) - second) < 400) ++close;
      }
  }
  EXPECT_GT(beams, 15'000);
  EXPECT_GT(seconds / beams, 0.01);
  EXPECT_LT(seconds / beams, 0.4);
  EXPECT_EQ(without_first, 0);
  EXPECT_EQ(close, 0) << "half a metre apart, but for the noise";
}
}  // namespace scanloom::receiver_unittest
