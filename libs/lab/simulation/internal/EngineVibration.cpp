#include "lab/simulation/internal/EngineVibration.h"

#include "base/core/Angle.h"
#include "lab/simulation/internal/Random.h"
#include "lab/simulation/internal/SmoothStep.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr double kStandardGravity = 9.80665;  // m/s2
constexpr int kBroadbandLines = 16;
constexpr double kEngineFade = 1.0;  // s from standstill to full vibration
}  // namespace

EngineVibration::EngineVibration(const EngineOptions& options, VibratingPart part, std::uint64_t seed)
  : starts_at_(options.starts_at)
{
  if (options.highest_frequency <= 0.5 * options.frequency)
    throw std::invalid_argument(
        fmt::format("[simulated_engine] highest_frequency = {} Hz: must be above half of frequency = {} Hz",
                    options.highest_frequency, options.frequency));
  const bool is_body = part == VibratingPart::Body;
  const double acceleration = kStandardGravity * (is_body ? options.acceleration : options.imu_mount);
  const double turn_rate = is_body ? kDegree * options.turn_rate_deg : 0;
  for (std::size_t axis = 0; axis < lines_.size(); ++axis)
  {
    Random random(seed, RandomStream::Engine, static_cast<std::uint64_t>(part), axis);
    const bool turns = axis > 2;
    const double share = axis < 2 ? options.sideways : 1;
    // A line's displacement is its acceleration / rate^2; its angle is its turn rate / rate.
    const auto add = [&](double frequency, double of_fundamental)
    {
      const double rate = 2 * M_PI * frequency;
      const double amplitude = of_fundamental * (turns ? turn_rate / rate : share * acceleration / (rate * rate));
      const double phase = random.uniform(0, 2 * M_PI);
      if (amplitude > 0) lines_[axis].push_back({rate, amplitude, phase});
    };
    for (int n = 1; n <= options.harmonics; ++n) add(n * options.frequency, std::pow(options.decay, n - 1));
    // One line at a random place of each equal part of the band; n lines of amplitude a have the mean square n a^2 / 2.
    const double lowest = 0.5 * options.frequency, width = (options.highest_frequency - lowest) / kBroadbandLines;
    for (int i = 0; i < kBroadbandLines; ++i)
      add(lowest + width * (i + random.uniform()), options.broadband * std::sqrt(2.0 / kBroadbandLines));
  }
}

Taylor EngineVibration::sumOf(const std::vector<Line>& lines, double t) const
{
  Taylor sum;
  for (const Line& line : lines) sum = sum + line.amplitude * sin(Taylor{line.rate * t + line.phase, line.rate, 0});
  if (starts_at_ <= 0) return sum;
  const SmoothStep on = smoothStep((t - starts_at_) / kEngineFade);
  return Taylor{on.value, on.first / kEngineFade, on.second / (kEngineFade * kEngineFade)} * sum;
}

Shake EngineVibration::at(double t) const
{
  return {{sumOf(lines_[0], t), sumOf(lines_[1], t), sumOf(lines_[2], t)}, sumOf(lines_[3], t), sumOf(lines_[4], t)};
}

Eigen::Vector3d EngineVibration::accelerationAt(double t) const
{
  const Shake shake = at(t);
  return {shake.place[0].acceleration, shake.place[1].acceleration, shake.place[2].acceleration};
}
}  // namespace scanloom
