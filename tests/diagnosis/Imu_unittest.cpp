/** ImuTiming, MeanForce, GyroScale and GyroAgreement on a swaying machine whose motion is known by formula. */
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "base/core/Angle.h"
#include "base/core/So3.h"
#include "diagnosis/internal/ImuComparison.h"
#include "diagnosis/internal/ImuSoundness.h"
#include "diagnosis/internal/ImuTiming.h"
#include "estimation/imu/GyroAgreement.h"
#include "estimation/imu/GyroScale.h"
#include "estimation/imu/MeanForce.h"
#include "support/peakMemory.h"

namespace scanloom::imu_unittest
{
namespace
{
const Timestamp kStart{1750000000s};

/** Small roll, pitch and yaw of the body about its origin, by time. */
Eigen::Vector3d attitude(double t)
{
  return {0.03 * std::sin(1.9 * t), 0.02 * std::sin(1.3 * t + 1) + 0.02 * std::sin(0.2 * t), 0.2 * std::sin(0.5 * t)};
}

/** What an IMU at body_T_imu measures, with the noise of a good one; turn rates by differences of the attitude. */
std::vector<ImuSample> swayingImu(const Rigid& body_T_imu, double duration = 30, double rate = 200, unsigned seed = 1,
                                  Duration late = 0ms)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> noise;
  const auto draw = [&] { return Eigen::Vector3d(noise(random), noise(random), noise(random)); };
  const auto position = [&](double t) { return Eigen::Vector3d(expSo3(attitude(t)) * body_T_imu.translation); };
  constexpr double h = 1e-3;
  std::vector<ImuSample> samples;
  for (double t = 0; t < duration; t += 1 / rate)
  {
    const Eigen::Quaterniond world_R_body = expSo3(attitude(t));
    const Eigen::Vector3d turn =
        logSo3(expSo3(attitude(t - h)).conjugate() * expSo3(attitude(t + h))) / (2 * h);  // in the body
    const Eigen::Vector3d acceleration = (position(t + h) - 2 * position(t) + position(t - h)) / (h * h);
    ImuSample sample;
    sample.stamp = kStart + fromSeconds(t) + late;
    const Eigen::Quaterniond imu_R_body = body_T_imu.rotation.conjugate();
    sample.gyro = imu_R_body * turn + 1e-3 * draw() + Eigen::Vector3d(2e-3, -1e-3, 3e-3);
    sample.accel =
        imu_R_body * (world_R_body.conjugate() * (acceleration + Eigen::Vector3d(0, 0, 9.80665))) + 0.02 * draw();
    samples.push_back(sample);
  }
  return samples;
}

Rigid at(double x, double y, double z, double yaw_deg, double pitch_deg, double roll_deg)
{
  return Rigid::fromXyzYawPitchRoll(x, y, z, yaw_deg * kDegree, pitch_deg * kDegree, roll_deg * kDegree);
}

std::vector<ImuSample> scaled(std::vector<ImuSample> samples, double gyro)
{
  for (ImuSample& sample : samples) sample.gyro *= gyro;
  return samples;
}
}  // namespace

TEST(ImuTiming, knowsTheRateAndWhatIsMissing)
{
  auto samples = swayingImu({}, 10, 100);
  samples.erase(samples.begin() + 500, samples.begin() + 530);
  samples.erase(samples.begin() + 100);
  const ImuTiming timing = imuTiming(samples);
  EXPECT_NEAR(*timing.rate, 100, 1e-3);
  EXPECT_EQ(timing.gaps, 1u);  // one missing sample is an interval of two: jitter may make as much
  EXPECT_EQ(timing.lost, 30u);
  EXPECT_NEAR(seconds(timing.longest_gap), 0.31, 1e-6);
  EXPECT_EQ(timing.backwards, 0u);
}

TEST(ImuTiming, countsStampsThatDoNotRise)
{
  auto samples = swayingImu({}, 1, 100);
  std::swap(samples[10], samples[11]);
  samples[50].stamp = samples[49].stamp;
  EXPECT_EQ(imuTiming(samples).backwards, 2u);
}

TEST(MeanForce, pointsUpOnASwayingMachine)
{
  const Rigid body_T_imu = at(0.5, -0.3, 2.8, 90, 10, -20);
  const Eigen::Vector3d up = body_T_imu.rotation * *meanForce(swayingImu(body_T_imu));
  EXPECT_LT(degreesBetween(up, Eigen::Vector3d::UnitZ()), 1);
  EXPECT_NEAR(up.norm(), 9.80665, 0.05);
  EXPECT_FALSE(meanForce({}));
}

TEST(MeanForce, unitsAreKnownByGravity)
{
  EXPECT_EQ(forceUnitOf(9.7), ForceUnit::MetresPerSecondSquared);
  EXPECT_EQ(forceUnitOf(1.02), ForceUnit::StandardGravity);
  EXPECT_EQ(forceUnitOf(990), ForceUnit::MilliGravity);
  EXPECT_EQ(forceUnitOf(0.1), ForceUnit::GravityTakenOut);
  EXPECT_EQ(forceUnitOf(5), ForceUnit::Unclear);
}

TEST(MeanForce, namesAxesAndTheTurnThatMendsThem)
{
  EXPECT_EQ(nearestAxis({0.1, -0.9, 0.2}), "-y");
  EXPECT_EQ(turnUpwards({0, 1, 0}), "+90 deg about x");
  EXPECT_EQ(turnUpwards({1, 0, 0}), "-90 deg about y");
  EXPECT_EQ(turnUpwards({0, 0, -1}), "180 deg about x or y");
  EXPECT_EQ(turnUpwards({1, 1, 0}), "90 deg about the axis (0.71 -0.71 0.00)");
  EXPECT_NEAR(degreesBetween({0, 0, 2}, {0, 3, 3}), 45, 1e-9);
}

using GyroUnits = testing::TestWithParam<double>;

TEST_P(GyroUnits, areToldByGravityWhereverTheImuSits)
{
  const double unit = GetParam();
  for (const Rigid& body_T_imu : {Rigid{}, at(1.5, 1.2, 2.5, 30, 15, -25)})
  {
    const auto found = gyroScale(scaled(swayingImu(body_T_imu), unit));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->scale * unit, 1, 0.15);
    EXPECT_LT(found->sigma * unit, 0.1);
    EXPECT_GT(found->explained, 0.5);
  }
}

INSTANTIATE_TEST_SUITE_P(RadiansDegreesAndBack, GyroUnits, testing::Values(1.0, 1 / kDegree, kDegree, -1.0));

TEST(GyroScale, aBiasInDegreesThatIsReadAsRadiansWouldTipTheMachineOver)
{
  auto samples = swayingImu({}, 20);
  for (ImuSample& sample : samples) sample.gyro = (sample.gyro + Eigen::Vector3d(0.3, 0, 0) * kDegree) / kDegree;
  EXPECT_NEAR(gyroScale(samples)->tilt_rate, 0.3, 0.2);
  EXPECT_LT(gyroScale(swayingImu({}, 20))->tilt_rate, 0.01);
}

TEST(GyroScale, onARoadThatShakesTheImuLittleIsExplained)
{
  std::mt19937 random(5);
  std::normal_distribution<double> shake(0, 1);
  auto samples = swayingImu({}, 60);
  for (std::size_t i = 0; i < samples.size(); i += 20)  // another push every tenth of a second
  {
    const Eigen::Vector3d push = 3 * Eigen::Vector3d(shake(random), shake(random), shake(random));
    for (std::size_t k = i; k < std::min(i + 20, samples.size()); ++k) samples[k].accel += push;
  }
  EXPECT_LT(gyroScale(samples)->explained, 0.3);
}

TEST(GyroScale, onALevelFloorTellsNoUnit)
{
  ImuSoundness hardly_turned;
  hardly_turned.gyro_scale = GyroScale{-3.0, 1.1};
  EXPECT_EQ(gyroFinding("imu", hardly_turned).verdict, Verdict::NotMeasured);
}

TEST(GyroScale, turnsDuringASilenceAreNotMeasured)
{
  std::vector<ImuSample> samples = swayingImu({}, 60);
  samples.erase(samples.begin() + 20 * 200, samples.begin() + 40 * 200);
  EXPECT_NEAR(gyroScale(samples)->scale, 1, 0.15);
}

TEST(GyroScale, needsFiveSeconds) { EXPECT_FALSE(gyroScale(swayingImu({}, 4))); }

TEST(GyroAgreement, leavesTurnsUnexplainedThatAreNoise)
{
  const auto imu = swayingImu({}, 30);
  const auto unexplainedWith = [&](double noise)
  {
    std::mt19937 random(6);
    std::normal_distribution<double> error(0, noise);
    std::vector<BodyTurn> turns;
    for (double t = 1; t < 28; t += 0.1)
      turns.push_back({kStart + fromSeconds(t), kStart + fromSeconds(t + 0.1),
                       logSo3(expSo3(attitude(t)).conjugate() * expSo3(attitude(t + 0.1))) +
                           Eigen::Vector3d(error(random), error(random), error(random))});
    return gyroAgreement(turns, {imu, {}})->unexplained;
  };
  EXPECT_LT(unexplainedWith(1e-4), 0.02);
  EXPECT_GT(unexplainedWith(5e-3), 0.1);
}

TEST(GyroAgreement, findsTheTurnBetweenTwoImus)
{
  const Rigid true_a = at(0.1, -0.3, 2.8, 90, 1, -1), true_b = at(1.5, 1.2, 2.5, 30, 15, -25);
  const auto a = swayingImu(true_a, 30, 200, 1), b = swayingImu(true_b, 30, 100, 2);
  const auto agreed = gyroAgreement({a, true_a}, {b, true_b});
  ASSERT_TRUE(agreed);
  EXPECT_LT(agreed->rotation.norm() / kDegree, 1);
  EXPECT_NEAR(agreed->scale, 1, 0.02);

  const Eigen::Vector3d wrong(0, 0, 20 * kDegree);  // about vertical: gravity can't tell
  const Rigid believed_b{expSo3(wrong).conjugate() * true_b.rotation, true_b.translation};
  const auto apart = gyroAgreement({a, true_a}, {b, believed_b});
  ASSERT_TRUE(apart);
  EXPECT_LT((apart->rotation - wrong).norm() / kDegree, 1);
}

TEST(GyroAgreement, findsTheLagOfTheLaterClock)
{
  const auto a = swayingImu({}, 30, 200, 1), b = swayingImu({}, 30, 100, 2, 137ms);
  const auto agreed = gyroAgreement({a, {}}, {b, {}});
  ASSERT_TRUE(agreed);
  EXPECT_NEAR(1e3 * seconds(agreed->lag), 137, 5);
}

TEST(GyroAgreement, aMonthWithoutSamplesIsNoMotionOfAMonth)
{
  auto a = swayingImu({}, 30, 200, 1), b = swayingImu({}, 30, 100, 2, 137ms);
  const auto without = gyroAgreement({a, {}}, {b, {}});
  const long before = peakMegabytes();
  for (auto* samples : {&a, &b})
  {
    samples->push_back(samples->back());
    samples->back().stamp += 30 * 24h;
  }
  const auto agreed = gyroAgreement({a, {}}, {b, {}});
  ASSERT_TRUE(agreed);
  EXPECT_EQ(agreed->rotation, without->rotation);
  EXPECT_EQ(agreed->lag, without->lag);
  EXPECT_LT(peakMegabytes() - before, 50);
}

TEST(GyroAgreement, goesOnBehindAGap)
{
  auto a = swayingImu({}, 60, 200, 1), b = swayingImu({}, 60, 100, 2);
  for (auto* samples : {&a, &b})
    for (ImuSample& sample : *samples)
      if (sample.stamp >= kStart + 20s) sample.stamp += 365 * 24h;
  const auto agreed = gyroAgreement({a, {}}, {b, {}});
  ASSERT_TRUE(agreed);
  EXPECT_LT(agreed->rotation.norm() / kDegree, 1);
  EXPECT_NEAR(agreed->scale, 1, 0.02);
}

TEST(GyroAgreement, saysNothingOfABodyThatTurnsAboutOneAxisOrNotAtAll)
{
  auto a = swayingImu({}, 30, 200, 1), b = swayingImu({}, 30, 100, 2);
  for (auto* samples : {&a, &b})
    for (ImuSample& sample : *samples) sample.gyro = {0, 0, sample.gyro.z()};
  EXPECT_FALSE(gyroAgreement({a, {}}, {b, {}}));
  EXPECT_FALSE(gyroAgreement({a, {}}, {{}, {}}));
}
namespace
{
struct ImuFault
{
  const char* name;
  Eigen::Matrix3d gyro;  // what becomes of the turn rates
  const char* told;
};

Eigen::Matrix3d yawed() { return Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix(); }

class WrongImus : public testing::TestWithParam<ImuFault>
{
 public:
  std::vector<std::vector<ImuSample>> samples;

  /** Three, of which the one at `wrong` has the fault. */
  std::vector<BodyImu> imus(std::size_t wrong)
  {
    const Rigid poses[] = {at(0, 0, 0, 0, 0, 0), at(1, 1, 2, 30, 15, -25), at(1, -1, 2, -30, 15, 25)};
    samples.clear();
    for (unsigned i = 0; i < 3; ++i) samples.push_back(swayingImu(poses[i], 30, 100, i + 1));
    for (ImuSample& sample : samples[wrong]) sample.gyro = GetParam().gyro * sample.gyro;
    std::vector<BodyImu> all;
    for (std::size_t i = 0; i < 3; ++i) all.push_back({std::to_string(i), samples[i], poses[i]});
    return all;
  }
};
}  // namespace

TEST_P(WrongImus, areNamedWhicheverIsTheFirst)
{
  for (std::size_t wrong = 0; wrong < 3; ++wrong)
  {
    const std::vector<BodyImu> all = imus(wrong);
    for (const ImuComparison& compared : compareImus(all))
    {
      const Finding finding = turnsFinding(compared, all[compared.imu].name, "another");
      EXPECT_EQ(finding.verdict >= Verdict::Warning, compared.imu == wrong) << finding.about << ": " << finding.says;
      if (compared.imu == wrong)
      {
        EXPECT_THAT(finding.mend, testing::HasSubstr(GetParam().told));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Each, WrongImus,
    testing::Values(ImuFault{"degrees", Eigen::Matrix3d::Identity() * 180 / M_PI, "they are in deg/s"},
                    ImuFault{"scale", Eigen::Matrix3d::Identity() * 1.05, "divide them by 1.05"},
                    ImuFault{"yawed", yawed(), "turn it by 90"},
                    ImuFault{"z_reversed", Eigen::Vector3d(1, 1, -1).asDiagonal(), "its turn rate about z is wrong"},
                    ImuFault{"y_reversed", Eigen::Vector3d(1, -1, 1).asDiagonal(), "its turn rate about y is wrong"}),
    [](const auto& fault) { return std::string(fault.param.name); });

TEST(ImuComparison, isNotFitWhereTheyTurnFiveDegreesOffOneAnother)
{
  const Rigid turned = Rigid::fromXyzYawPitchRoll(0, 0, 0, 0, 0, 5 * kDegree);
  const std::vector<ImuSample> a = swayingImu({}), b = swayingImu(turned, 30, 100, 2);
  const Finding finding = turnsFinding(compareImus({{"a", a, {}}, {"b", b, {}}}).front(), "b", "a", {});
  EXPECT_EQ(finding.verdict, Verdict::NotFit) << finding.says;
}

TEST(ImuComparison, ofTwoThatDifferNamesBoth)
{
  const std::vector<ImuSample> a = swayingImu({}), b = scaled(swayingImu({}, 30, 100, 2), 1.1);
  const std::vector<ImuComparison> compared = compareImus({{"a", a, {}}, {"b", b, {}}});
  ASSERT_EQ(compared.size(), 1u);
  EXPECT_FALSE(compared[0].outvoted);
  EXPECT_THAT(turnsFinding(compared[0], "b", "a").mend, testing::HasSubstr("or of a"));
}
}  // namespace scanloom::imu_unittest
