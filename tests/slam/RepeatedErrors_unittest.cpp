#include "slam/RepeatedErrors.h"

#include <gtest/gtest.h>

using namespace scanloom;

namespace
{
constexpr double kLength = 2;  // m

/** Registrations 0.1 s apart, each `step` m on from the one before. */
RepeatedErrors after(int registrations, double step)
{
  RepeatedErrors errors;
  for (int i = 0; i < registrations; ++i) errors.add(Timestamp(i * 100ms), {i * step, 0, 0});
  return errors;
}
}  // namespace

TEST(RepeatedErrors, countAsOneMeasurementPerLengthOfTravel)
{
  EXPECT_NEAR(after(10, 0.1).registrationsAlike(kLength), 20, 1e-9);
  EXPECT_NEAR(after(10, 0.4).registrationsAlike(kLength), 5, 1e-9);
  EXPECT_EQ(after(10, 3).registrationsAlike(kLength), 1) << "no registration is more than one measurement";
}

TEST(RepeatedErrors, ofASecondCountAsOneWhereTheMachineStands)
{
  EXPECT_FALSE(after(10, 0).stands()) << "0.9 s";
  EXPECT_EQ(after(10, 0).registrationsAlike(kLength), 100) << "as if it had moved by 2 cm";
  EXPECT_TRUE(after(11, 0).stands());
  EXPECT_NEAR(after(11, 0).registrationsAlike(kLength), 10, 1e-9);
  EXPECT_EQ(after(11, 0).registrationsWithin(kLength), 100) << "attitudes err alike at rest, too";
}

TEST(RepeatedErrors, standInSpiteOfScatterButNotAtSixCentimetresPerSecond)
{
  RepeatedErrors scattered;
  for (int i = 0; i <= 100; ++i) scattered.add(Timestamp(i * 100ms), {i % 2 ? 0.04 : 0, 0, 0});
  EXPECT_TRUE(scattered.stands());
  EXPECT_FALSE(after(101, 0.006).stands());
}

TEST(RepeatedErrors, ofTheFirstRegistrationCountAsIfItHadTravelledTwoCentimetres)
{
  EXPECT_EQ(after(1, 0).travel(), 0);
  EXPECT_EQ(after(1, 0).registrationsAlike(kLength), 100);
  EXPECT_FALSE(after(0, 0).stands());
}

TEST(RepeatedErrors, ofScansMoreThanASecondApartCountOncePerScanAtRest)
{
  RepeatedErrors slow;
  for (int i = 0; i < 3; ++i) slow.add(Timestamp(i * 1500ms), Eigen::Vector3d::Zero());
  EXPECT_EQ(slow.registrationsAlike(kLength), 1);
}
