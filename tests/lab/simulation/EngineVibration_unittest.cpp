#include "lab/simulation/internal/EngineVibration.h"
#include "lab/simulation/internal/SimulatedImu.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace scanloom::engine_vibration_unittest
{
namespace
{
constexpr double kGravity = 9.80665;

EngineOptions oneLine(double acceleration, double frequency)
{
  EngineOptions options;
  options.acceleration = acceleration;
  options.frequency = frequency;
  options.harmonics = 1;
  options.broadband = 0;
  return options;
}

EngineVibration bodyOf(const EngineOptions& options) { return {options, VibratingPart::Body, 1}; }

/** Root mean square of an acceleration over 20 s. */
double rms(const EngineVibration& engine, int axis)
{
  double squares = 0;
  const int samples = 40'000;
  for (int i = 0; i < samples; ++i) squares += std::pow(engine.accelerationAt(20.0 * i / samples)[axis], 2);
  return std::sqrt(squares / samples);
}

Drive parkedWith(const EngineVibration& engine)
{
  DriveOptions options;
  options.route = "work";
  options.standstill = options.duration + 1;
  options.speed_up = 1;
  return {Route(options, {}, 1), options, {}, Ground(GroundOptions{0, 0}), engine};
}

std::vector<ImuSample> samplesOf(const Drive& drive, double rate, const EngineVibration& mount = {})
{
  const RecordingSpan span{Timestamp{}, 20};
  ImuStream imu(drive, span, {{}, Timestamp{}, {rate, 0, 0, 0, 0, 1, 0, 0}, {}, RandomStream::BodyImu, 0, mount}, 7);
  std::vector<ImuSample> samples;
  for (const ImuStream::Sample& sample : imu.before(span.end())) samples.push_back(sample.reading);
  return samples;
}
}  // namespace

/** x = a / (2 pi f)^2 */
TEST(EngineVibration, of03gAt30HzMovesTheBodyBy83Micrometres)
{
  const EngineVibration engine = bodyOf(oneLine(0.3, 30));
  double farthest = 0, strongest = 0;
  for (double t = 0; t < 1; t += 1e-5)
  {
    farthest = std::max(farthest, std::abs(engine.at(t).place[2].value));
    strongest = std::max(strongest, engine.accelerationAt(t).z());
  }
  EXPECT_NEAR(farthest, 82.8e-6, 0.1e-6);
  EXPECT_NEAR(strongest, 0.3 * kGravity, 1e-3);
}

TEST(EngineVibration, hasTheAccelerationsThatWereAskedFor)
{
  EngineOptions options = oneLine(0.6, 25);
  options.sideways = 0.5;
  EXPECT_NEAR(rms(bodyOf(options), 2), 0.6 * kGravity / std::sqrt(2), 0.02);
  EXPECT_NEAR(rms(bodyOf(options), 0), 0.3 * kGravity / std::sqrt(2), 0.02);

  options.harmonics = 3;
  options.decay = 0.5;
  EXPECT_NEAR(rms(bodyOf(options), 2), 0.6 * kGravity * std::sqrt((1 + 1.0 / 4 + 1.0 / 16) / 2), 0.03);

  options.decay = 0;
  options.broadband = 1;
  EXPECT_NEAR(rms(bodyOf(options), 2), 0.6 * kGravity * std::sqrt(1.5), 0.2) << "lines may lie near to each other";
}

TEST(EngineVibration, goesOnAtRestAndBeforeTheRecording)
{
  const Drive drive = parkedWith(bodyOf(oneLine(0.3, 30)));
  for (const double from : {-5.0, 0.0, 20.0})
  {
    double strongest = 0;
    for (double t = from; t < from + 0.1; t += 1e-4) strongest = std::max(strongest, drive.at(t).acceleration.z());
    EXPECT_NEAR(strongest, 0.3 * kGravity, 0.01) << from;
  }
}

TEST(EngineVibration, refusesABandThatEndsBeforeItBegins)
{
  EngineOptions options = oneLine(0.3, 100);
  options.highest_frequency = 50;
  EXPECT_THROW(bodyOf(options), std::invalid_argument);
}

TEST(EngineVibration, beginsWhenTheEngineStarts)
{
  EngineOptions options = oneLine(0.3, 30);
  options.starts_at = 5;
  const EngineVibration engine = bodyOf(options);
  EXPECT_EQ(engine.accelerationAt(4.9).norm(), 0);
  EXPECT_GT(engine.accelerationAt(6.1).norm(), 0);
}

/** The mean of sin(2 pi f t) over T around t is sin(pi f T) / (pi f T) of it. */
TEST(EngineVibration, isAveragedOverTheTimeBetweenTwoReadings)
{
  for (const double frequency : {30.0, 70.0, 150.0, 199.0})
  {
    double squares = 0;
    const auto samples = samplesOf(parkedWith(bodyOf(oneLine(0.3, frequency))), 200);
    for (const ImuSample& sample : samples) squares += std::pow(sample.accel.z() - 9.81, 2);
    const double turns = M_PI * frequency / 200;
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(samples.size())),
                0.3 * kGravity / std::sqrt(2) * std::sin(turns) / turns, 0.02)
        << frequency << " Hz";
  }
}

TEST(EngineVibration, ofTheMountIsSeenByTheImuAlone)
{
  EngineOptions options = oneLine(0, 30);
  options.imu_mount = 0.3;
  const EngineVibration body = bodyOf(options), mount(options, VibratingPart::ImuMount, 1);
  EXPECT_TRUE(body.isStill());
  const Drive drive = parkedWith(body);
  double strongest = 0;
  for (const ImuSample& sample : samplesOf(drive, 500, mount)) strongest = std::max(strongest, sample.accel.z() - 9.81);
  EXPECT_NEAR(strongest, 0.3 * kGravity, 0.05);
  EXPECT_EQ(drive.at(3).acceleration.norm(), 0);
}
}  // namespace scanloom::engine_vibration_unittest
