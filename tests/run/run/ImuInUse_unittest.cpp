#include "run/run/ImuInUse.h"

#include "base/core/ConfigError.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <set>

namespace scanloom::imu_in_use_unittest
{
namespace
{
/** Two lidars; IMUs are named by their sensors, each 1 m further along x. */
class InputWithImus : public SensorInput
{
 public:
  explicit InputWithImus(const std::set<int>& imus)
  {
    setup_.header.lidars.resize(2);
    setup_.header.lidars[0].name = "left";
    setup_.header.lidars[1].name = "right";
    for (const int imu : imus) setup_.body_T_imu[imu] = Rigid::fromXyzYawPitchRoll(imu, 0, 0, 0, 0, 0);
  }
  std::optional<SensorEvent> next(Duration) override { return std::nullopt; }
  bool ended() const override { return true; }
  void stop() override {}
  SensorSetup setup() const override { return setup_; }

 private:
  SensorSetup setup_;
};

constexpr int kBody = SensorImu::kBody, kLeft = 0, kRight = 1;

/** A reading that differs from every other one, on a machine that sways. */
SensorImu sampleAt(int sensor, Duration t)
{
  ImuSample sample{Timestamp{t}};
  sample.gyro.setConstant(0.1 * std::sin(3 * seconds(t)));
  sample.accel.setConstant(seconds(t));
  return {sensor, sample};
}

TEST(ImuInUse, isTheBodysOrElseTheFirstLidarsThatHasOne)
{
  EXPECT_EQ(ImuInUse(InputWithImus({kBody, kLeft, kRight}), "auto", {}).name(), "body");
  EXPECT_EQ(ImuInUse(InputWithImus({kLeft, kRight}), "auto", {}).name(), "left");
  EXPECT_EQ(ImuInUse(InputWithImus({kRight}), "auto", {}).name(), "right");
  EXPECT_EQ(ImuInUse(InputWithImus({kBody, kRight}), "right", {}).name(), "right");
}

TEST(ImuInUse, isRefusedWithTheOnesThereAre)
{
  const auto refusalOf = [](const std::set<int>& imus, const char* wanted)
  { return messageOf<ConfigError>([&] { ImuInUse(InputWithImus(imus), wanted, {}); }); };
  EXPECT_THAT(refusalOf({kBody, kRight}, "left"), testing::HasSubstr("imu = left: the input has no such IMU"));
  EXPECT_THAT(refusalOf({}, "auto"), testing::HasSubstr("no such IMU"));
}

/** A second of readings of the body's IMU and the left lidar's, of noise that is `shaken` times as large in the body's.
 */
ImuInUse afterASecond(const InputWithImus& input, const std::string& wanted, double shaken)
{
  ImuInUse imu(input, wanted, {});
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0, 0.01);
  for (Duration t{0}; t <= 1s; t += 10ms)
    for (const int sensor : {kBody, kLeft})
    {
      SensorImu read = sampleAt(sensor, t);
      const double scale = sensor == kBody ? shaken : 1;
      read.sample.gyro.x() += scale * noise(random);
      read.sample.accel = {scale * noise(random), scale * noise(random), 9.8 + scale * noise(random)};
      imu.take(read);
    }
  return imu;
}

TEST(ImuInUse, givesWayForGoodToOneThatShakesATenthAsMuch)
{
  const InputWithImus input({kBody, kLeft});
  ImuInUse imu = afterASecond(input, "auto", 6);
  EXPECT_TRUE(imu.changeIfShaken());
  EXPECT_EQ(imu.name(), "left");
  EXPECT_FALSE(imu.changeIfShaken());
  for (Duration t = 1s; t < 8s; t += 10ms)
    for (const int sensor : {kBody, kLeft}) imu.take(sampleAt(sensor, t));
  EXPECT_FALSE(imu.returnToBetter(Timestamp{8s}));
}

TEST(ImuInUse, isKeptWhereItShakesAsTheOthersDoOrWasChosenByName)
{
  const InputWithImus input({kBody, kLeft});
  EXPECT_FALSE(afterASecond(input, "auto", 1).changeIfShaken());
  EXPECT_FALSE(afterASecond(input, "body", 6).changeIfShaken());
}

TEST(ImuInUse, givesWayToAnotherAfterAFifthOfASecondOfSilenceWithWhatThatSaidSinceThen)
{
  const InputWithImus input({kLeft, kRight});
  ImuInUse imu(input, "auto", {});
  EXPECT_EQ(imu.take(sampleAt(kLeft, 1s)).size(), 1u);
  for (const Duration t : {1s + 0ms, 1s + 100ms, 1s + 300ms}) EXPECT_TRUE(imu.take(sampleAt(kRight, t)).empty());

  EXPECT_FALSE(imu.changeIfSilent(Timestamp{1200ms}));
  EXPECT_TRUE(imu.changeIfSilent(Timestamp{1300ms}));

  EXPECT_EQ(imu.name(), "right");
  EXPECT_EQ(imu.previousName(), "left");
  EXPECT_EQ(imu.body_T_imu().translation.x(), kRight);
  EXPECT_EQ(imu.recent().size(), 3U);
  EXPECT_EQ(imu.previous().size(), 1U);
  EXPECT_EQ(imu.take(sampleAt(kRight, 1400ms)).size(), 1u);
  EXPECT_FALSE(imu.changeIfSilent(Timestamp{1400ms})) << "the first one has not come back";
}

TEST(ImuInUse, thatReadsNothingButNanOrOldStampsIsSilent)
{
  const InputWithImus input({kLeft, kRight});
  for (const bool nan : {false, true})
  {
    ImuInUse imu(input, "auto", {});
    imu.take(sampleAt(kLeft, 1s));
    imu.take(sampleAt(kRight, 2s));
    SensorImu useless = sampleAt(kLeft, nan ? 2s : 500ms);
    if (nan) useless.sample.gyro.setConstant(NAN);
    EXPECT_TRUE(imu.take(useless).empty());
    EXPECT_EQ(imu.refused().at("left").unusable, 1u);

    EXPECT_TRUE(imu.changeIfSilent(Timestamp{2s})) << nan;
  }
}

TEST(ImuInUse, staysWithASilentOneIfNoOtherSpeaksOrItWasChosenByName)
{
  const InputWithImus input({kBody, kLeft});
  ImuInUse alone(input, "auto", {}), chosen(input, "body", {});
  for (ImuInUse* imu : {&alone, &chosen}) imu->take(sampleAt(kBody, 1s));
  chosen.take(sampleAt(kLeft, 9s));

  EXPECT_FALSE(alone.changeIfSilent(Timestamp{9s}));
  EXPECT_FALSE(chosen.changeIfSilent(Timestamp{9s}));
}

TEST(ImuInUse, letsScansWaitUntilItCountsAsSilentWhereAnotherMayTakeOver)
{
  EXPECT_EQ(ImuInUse(InputWithImus({kBody}), "auto", {}).patience(50ms), 50ms);
  EXPECT_EQ(ImuInUse(InputWithImus({kBody, kLeft}), "body", {}).patience(50ms), 50ms);
  EXPECT_EQ(ImuInUse(InputWithImus({kBody, kLeft}), "auto", {}).patience(50ms), 200ms);
  EXPECT_EQ(ImuInUse(InputWithImus({kBody, kLeft}), "auto", 30ms).patience(50ms), 230ms);
  EXPECT_EQ(ImuInUse(InputWithImus({kBody, kLeft}), "auto", {}).patience(1s), 1s);
}

TEST(ImuInUse, isNotSilentForItsDelay)
{
  const InputWithImus input({kBody, kLeft});
  for (const Duration delay : {-400ms, 400ms})
  {
    ImuInUse imu(input, "auto", delay);
    imu.take(sampleAt(kBody, 1s + std::min(delay, Duration{0})));
    imu.take(sampleAt(kLeft, 1s));
    EXPECT_FALSE(imu.changeIfSilent(Timestamp{1100ms})) << seconds(delay);
  }
}

TEST(ImuInUse, hasItsDelayTakenOffAndOthersDoNot)
{
  const InputWithImus input({kBody, kLeft});
  ImuInUse imu(input, "auto", 20ms);
  EXPECT_EQ(imu.take(sampleAt(kBody, 1s)).at(0).stamp, Timestamp{980ms});
  imu.take(sampleAt(kLeft, 2s));

  ASSERT_TRUE(imu.changeIfSilent(Timestamp{2s}));
  EXPECT_EQ(imu.recent().front().stamp, Timestamp{2s});
  EXPECT_EQ(imu.take(sampleAt(kLeft, 3s)).at(0).stamp, Timestamp{3s});

  imu.take(sampleAt(kBody, 4s));
  ASSERT_TRUE(imu.changeIfSilent(Timestamp{4s}));
  EXPECT_EQ(imu.recent().back().stamp, Timestamp{3980ms});
}

TEST(ImuInUse, thatHangsIsSilent)
{
  const InputWithImus input({kBody, kLeft});
  ImuInUse imu(input, "auto", {});
  for (Duration t = 1s; t <= 1500ms; t += 10ms)
  {
    SensorImu frozen = sampleAt(kBody, 1s);
    frozen.sample.stamp = Timestamp{t};
    imu.take(frozen);
    imu.take(sampleAt(kLeft, t));
    EXPECT_EQ(imu.changeIfSilent(Timestamp{t}), t == 1210ms) << seconds(t);
  }
}

/** The body's IMU is there from 2 s on, with stamps late by `late`. The time of the return to it. */
std::optional<Duration> returnOfTheBodys(Duration late)
{
  const InputWithImus input({kBody, kLeft});
  ImuInUse imu(input, "auto", {});
  for (Duration t = 1s; t <= 20s; t += 10ms)
  {
    SensorImu of_body = sampleAt(kBody, t);
    of_body.sample.stamp += late;
    if (t >= 2s) imu.take(of_body);
    imu.take(sampleAt(kLeft, t));
    imu.changeIfSilent(Timestamp{t});
    if (imu.returnToBetter(Timestamp{t})) return t;
  }
  return std::nullopt;
}

TEST(ImuInUse, returnsToTheBodysWhenThatWasHeardForFiveSecondsAndTurnsLikeTheOther)
{
  const std::optional<Duration> back = returnOfTheBodys(0ms);
  ASSERT_TRUE(back);
  EXPECT_NEAR(seconds(*back), 7, 0.3);
  EXPECT_FALSE(returnOfTheBodys(1s));
}

TEST(ImuInUse, doesNotReturnToOneThatFallsSilentAgainAndAgain)
{
  const InputWithImus input({kBody, kLeft});
  ImuInUse imu(input, "auto", {});
  for (Duration t = 0s; t <= 20s; t += 10ms)
  {
    if (t > 1s && t % 3s > 300ms) imu.take(sampleAt(kBody, t));
    imu.take(sampleAt(kLeft, t));
    imu.changeIfSilent(Timestamp{t});
    EXPECT_FALSE(imu.returnToBetter(Timestamp{t}));
  }
  EXPECT_EQ(imu.name(), "left");
}
}  // namespace
}  // namespace scanloom::imu_in_use_unittest
