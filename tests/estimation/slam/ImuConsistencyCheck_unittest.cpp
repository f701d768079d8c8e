#include "estimation/slam/ImuConsistencyCheck.h"

#include <gmock/gmock.h>

#include "estimation/imu/AnalyticDrive.h"

namespace scanloom::imu_consistency_check_unittest
{
using testing::HasSubstr;

namespace
{
const Rigid kBodyTImu = Rigid::fromXyzYawPitchRoll(0.1, -0.3, 2.8, 1.2, 0.02, -0.01);

StateEstimate registeredAt(Timestamp stamp)
{
  StateEstimate estimate;
  estimate.stamp = stamp;
  estimate.registration.emplace();
  estimate.registration->outcome = Outcome::Converged;
  estimate.registration->target_T_source = AnalyticDrive().stateAt(stamp).map_T_imu * kBodyTImu.inverse();
  return estimate;
}

/** Of a minute: scans every `period`, the IMU's samples as `change` makes them. */
template <typename Change>
ImuConsistencyCheck watched(Change&& change, Duration period = 100ms, const Rigid& believed = kBodyTImu)
{
  ImuConsistencyCheck watch(believed);
  for (ImuSample sample : AnalyticDrive().samples(Timestamp{9s}, Timestamp{71s}, 5ms))
  {
    change(sample);
    watch.add(sample);
  }
  for (Timestamp stamp{10s}; stamp < Timestamp{70s}; stamp += period) watch.add(registeredAt(stamp));
  return watch;
}

std::vector<ImuSample> atRest(const Eigen::Vector3d& force)
{
  return std::vector<ImuSample>(5, {Timestamp{}, Eigen::Vector3d::Zero(), force});
}

std::string refusalOf(const Eigen::Vector3d& force)
{
  try
  {
    requireGravity(atRest(force), {});
  }
  catch (const std::runtime_error& e)
  {
    return e.what();
  }
  return "";
}
}  // namespace

TEST(ImuConsistencyCheck, hasNothingToSayOfAnImuThatAgrees)
{
  const ImuConsistencyCheck watch = watched([](ImuSample&) {});
  EXPECT_FALSE(watch.complaint());
  ASSERT_TRUE(watch.agreement());
  EXPECT_LT(std::abs(seconds(watch.agreement()->lag)), 1e-3);
  EXPECT_LT(watch.agreement()->rotation.norm(), 0.01);
}

TEST(ImuConsistencyCheck, namesHowLateItsStampsAreAtEveryN)
{
  for (const Duration period : {100ms, 500ms, 1500ms})
    for (const Duration late : {50ms, -30ms})
    {
      const ImuConsistencyCheck watch = watched([&](ImuSample& s) { s.stamp += late; }, period);
      ASSERT_TRUE(watch.agreement());
      EXPECT_NEAR(seconds(watch.agreement()->lag), seconds(late), 2e-3) << seconds(period);
    }
  EXPECT_THAT(*watched([](ImuSample& s) { s.stamp += 50ms; }).complaint(), HasSubstr("imu_delay_ms = 50"));
}

TEST(ImuConsistencyCheck, namesByHowMuchItsPoseIsTurned)
{
  const Rigid turned = Rigid::fromXyzYawPitchRoll(0, 0, 0, M_PI / 2, 0, 0) * kBodyTImu;
  EXPECT_THAT(*watched([](ImuSample&) {}, 100ms, turned).complaint(), HasSubstr("wrong by 90.0 deg"));
}

TEST(ImuConsistencyCheck, namesAGyroscopeInDegreesAndALeftHandedOne)
{
  EXPECT_THAT(watched([](ImuSample& s) { s.gyro *= 180 / M_PI; }).complaint().value_or(""), HasSubstr("in deg/s"));
  EXPECT_THAT(watched([](ImuSample& s) { s.gyro *= -1; }).complaint().value_or(""), HasSubstr("left-handed"));
}

TEST(ImuConsistencyCheck, leavesOutWhatIsNotFinite)
{
  int number = 0;
  const ImuConsistencyCheck watch = watched(
      [&](ImuSample& s)
      {
        if (++number % 10 == 0) s.gyro.x() = std::nan("");
      });
  ASSERT_TRUE(watch.agreement());
  EXPECT_TRUE(watch.agreement()->rotation.allFinite());
  EXPECT_FALSE(watch.complaint());
}

TEST(ImuConsistencyCheck, saysNothingWithoutRegistrationsOrMotion)
{
  ImuConsistencyCheck watch(kBodyTImu);
  EXPECT_FALSE(watch.complaint());
  for (const ImuSample& sample : AnalyticDrive().samples(Timestamp{0s}, Timestamp{20s}, 5ms)) watch.add(sample);
  EXPECT_FALSE(watch.agreement());
}

TEST(RequireGravity, namesTheUnitAndTheAxis)
{
  EXPECT_EQ(refusalOf({0, 0, 9.8}), "");
  EXPECT_EQ(refusalOf({0, 5, 8.5}), "") << "a slope of 30 deg";
  EXPECT_THAT(refusalOf({0, 0, 1}), HasSubstr("in g: multiply"));
  EXPECT_THAT(refusalOf({0, 0, 0.05}), HasSubstr("gravity was taken out"));
  EXPECT_THAT(refusalOf({0, 9.8, 0}),
              HasSubstr("up is along +y of the body: its pose in the body is wrong by +90 deg about x"));
  EXPECT_THAT(refusalOf({0, 0, -9.8}), HasSubstr("signs"));
}
}  // namespace scanloom::imu_consistency_check_unittest
