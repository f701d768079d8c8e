#include "estimation/imu/ImuScreening.h"

#include <gtest/gtest.h>

#include "AnalyticDrive.h"

#include <functional>
#include <limits>

namespace scanloom::imu_screening_unittest
{
namespace
{
using Change = std::function<void(ImuSample&, double t)>;

struct Screened
{
  std::vector<ImuSample> passed;
  RefusedReadings refused;
};

/** Ten seconds of a drive, as `change` leaves its readings. */
Screened screen(const Change& change, Duration period = 5ms)
{
  ImuScreening screening;
  Screened screened;
  for (ImuSample sample : AnalyticDrive{}.samples(Timestamp{0s}, Timestamp{10s}, period))
  {
    change(sample, seconds(sample.stamp.time_since_epoch()));
    for (const ImuSample& passed : screening.pass(sample)) screened.passed.push_back(passed);
  }
  screened.refused = screening.refused();
  return screened;
}

bool isWithin(double t, double from, double to) { return t > from - 1e-6 && t < to - 1e-6; }
}  // namespace

TEST(ImuScreening, passesTheReadingsOfADriveAtOnceAndUnchanged)
{
  ImuScreening screening;
  for (const ImuSample& sample : AnalyticDrive{}.samples(Timestamp{0s}, Timestamp{10s}, 5ms))
  {
    const std::vector<ImuSample> passed = screening.pass(sample);
    ASSERT_EQ(passed.size(), 1u);
    EXPECT_EQ(passed.front().stamp, sample.stamp);
    EXPECT_EQ(passed.front().gyro, sample.gyro);
    EXPECT_EQ(passed.front().accel, sample.accel);
    EXPECT_FALSE(passed.front().after_refused);
  }
}

TEST(ImuScreening, passesVibrationOf06gAndShocksOf15gAtAnyRate)
{
  constexpr double kVibration = 0.6 * kGravity, kShock = 1.5 * kGravity;
  for (const Duration period : std::initializer_list<Duration>{1ms, 2500us, 5ms, 10ms})
    for (const double frequency : {23.0, 97.0, 180.0, 437.0})
    {
      const Screened screened = screen(
          [&](ImuSample& sample, double t)
          {
            sample.accel.z() += kVibration * std::sin(2 * M_PI * frequency * t);
            sample.gyro.y() += 0.3 * std::sin(2 * M_PI * frequency * t);
            const double since_shock = std::fmod(t, 1.7);
            if (since_shock < 0.02) sample.accel.x() += kShock * std::sin(M_PI * since_shock / 0.02);
          },
          period);
      EXPECT_EQ(screened.refused.sum(), 0u) << period.count() << " ns, " << frequency << " Hz";
    }
}

TEST(ImuScreening, refusesWhatIsBeyondTheRangeOfSuchSensorsAndMarksTheNext)
{
  const Screened screened = screen(
      [](ImuSample& sample, double t)
      {
        if (isWithin(t, 3, 3.005)) sample.accel.x() += 200;
        if (isWithin(t, 4, 4.005)) sample.gyro.z() = 1e6;
      });
  EXPECT_EQ(screened.refused.beyond_range, 2u);
  EXPECT_EQ(screened.refused.sum(), 2u);
  for (const ImuSample& sample : screened.passed)
    EXPECT_EQ(sample.after_refused, sample.stamp == Timestamp{3005ms} || sample.stamp == Timestamp{4005ms});
}

TEST(ImuScreening, refusesASpikeOfSeveralSamplesThatReturns)
{
  const Screened screened = screen(
      [](ImuSample& sample, double t)
      {
        if (isWithin(t, 3, 3.02)) sample.accel.x() += 20;
        if (isWithin(t, 6, 6.01)) sample.gyro.z() -= 5;
      });
  EXPECT_EQ(screened.refused.spikes, 6u);
  EXPECT_EQ(screened.refused.sum(), 6u);
}

TEST(ImuScreening, passesAMotionThatStaysWithNothingLeftOut)
{
  const Screened screened = screen(
      [](ImuSample& sample, double t)
      {
        if (isWithin(t, 3, 3.2)) sample.accel.x() += 30;
      });
  EXPECT_EQ(screened.refused.sum(), 0u);
  EXPECT_EQ(screened.passed.size(), 2001u);
}

TEST(ImuScreening, refusesASpikeThatSilenceFollows)
{
  ImuScreening screening;
  ImuSample sample;
  screening.pass(sample);
  sample.stamp += 5ms;
  sample.gyro.x() = 0.1;
  sample.accel.x() = 30;
  EXPECT_TRUE(screening.pass(sample).empty());
  sample.stamp += 5s;
  EXPECT_EQ(screening.pass(sample).size(), 1u);
  EXPECT_EQ(screening.refused().spikes, 1u);
}

TEST(ImuScreening, takesConstantReadingsForSilenceAfterTheFirst)
{
  for (const bool gyro : {false, true})
    for (const bool accel : {false, true})
    {
      std::optional<ImuSample> frozen;
      const Screened screened = screen(
          [&](ImuSample& sample, double t)
          {
            if (!isWithin(t, 3, 5)) return;
            if (!frozen) frozen = sample;
            if (gyro) sample.gyro = frozen->gyro;
            if (accel) sample.accel = frozen->accel;
          });
      EXPECT_EQ(screened.refused.constant, gyro || accel ? 399u : 0u) << gyro << accel;
      EXPECT_EQ(screened.passed.size() + screened.refused.sum(), 2001u);
    }
}

TEST(ImuScreening, passesReadingsThatADriverGivesOutSeveralTimes)
{
  ImuSample last_even, last_odd;
  int number = 0;
  const Screened both = screen(
      [&](ImuSample& sample, double)
      {
        if (number++ % 4 == 0) last_even = sample;
        sample.gyro = last_even.gyro;
        sample.accel = last_even.accel;
      });
  EXPECT_EQ(both.refused.sum(), 0u);

  number = 0;
  const Screened in_turn = screen(
      [&](ImuSample& sample, double)
      {
        (number++ % 2 == 0 ? last_even : last_odd) = sample;
        sample.gyro = last_even.gyro;
        sample.accel = last_odd.accel;
      });
  EXPECT_EQ(in_turn.refused.sum(), 0u);
  EXPECT_GE(in_turn.passed.size(), 1999u);
  for (std::size_t i = 1; i < in_turn.passed.size(); ++i)
    EXPECT_EQ(in_turn.passed[i].stamp - in_turn.passed[i - 1].stamp, 5ms);
}

TEST(ImuScreening, refusesWhatIsNotFiniteOrNotInOrder)
{
  const Screened screened = screen(
      [](ImuSample& sample, double t)
      {
        if (isWithin(t, 3, 3.005)) sample.accel.x() = std::numeric_limits<double>::infinity();
        if (isWithin(t, 4, 4.005)) sample.gyro.x() = std::numeric_limits<double>::quiet_NaN();
        if (isWithin(t, 5, 5.005)) sample.stamp -= 1s;
      });
  EXPECT_EQ(screened.refused.unusable, 3u);
  EXPECT_EQ(screened.refused.sum(), 3u);
  EXPECT_EQ(screened.refused.toString(), "3 not finite or out of order");
}
}  // namespace scanloom::imu_screening_unittest
