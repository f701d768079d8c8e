#include "estimation/slam/internal/MeasurementCorrelation.h"

#include <gtest/gtest.h>

namespace scanloom::measurement_correlation_unittest
{
namespace
{
constexpr double kLength = 2;  // m

/** Registrations 0.1 s apart, each `step` m on from the one before. */
MeasurementCorrelation after(int registrations, double step)
{
  MeasurementCorrelation errors;
  for (int i = 0; i < registrations; ++i) errors.add(Timestamp(i * 100ms), {i * step, 0, 0});
  return errors;
}
}  // namespace

TEST(MeasurementCorrelation, countAsOneMeasurementPerLengthOfTravel)
{
  EXPECT_NEAR(after(10, 0.1).registrationsPerTravelOrRest(kLength), 20, 1e-9);
  EXPECT_NEAR(after(10, 0.4).registrationsPerTravelOrRest(kLength), 5, 1e-9);
  EXPECT_EQ(after(10, 3).registrationsPerTravelOrRest(kLength), 1) << "no registration is more than one measurement";
}

TEST(MeasurementCorrelation, ofASecondCountAsOneWhereTheMachineStands)
{
  EXPECT_EQ(after(10, 0).registrationsPerTravelOrRest(kLength), 100) << "0.9 s, as if it had moved by 2 cm";
  EXPECT_NEAR(after(11, 0).registrationsPerTravelOrRest(kLength), 10, 1e-9);
  EXPECT_EQ(after(11, 0).registrationsPerTravel(kLength), 100) << "attitudes err alike at rest, too";
}

TEST(MeasurementCorrelation, standInSpiteOfScatterButNotAtSixCentimetresPerSecond)
{
  MeasurementCorrelation scattered;
  for (int i = 0; i <= 100; ++i) scattered.add(Timestamp(i * 100ms), {i % 2 ? 0.04 : 0, 0, 0});
  EXPECT_NEAR(scattered.registrationsPerTravelOrRest(kLength), 10, 1e-9);
  EXPECT_EQ(after(101, 0.006).registrationsPerTravelOrRest(kLength), 100);
}

TEST(MeasurementCorrelation, ofTheFirstRegistrationCountAsIfItHadTravelledTwoCentimetres)
{
  EXPECT_EQ(after(1, 0).travel(), 0);
  EXPECT_EQ(after(1, 0).registrationsPerTravelOrRest(kLength), 100);
  EXPECT_EQ(after(0, 0).registrationsPerTravelOrRest(kLength), 100) << "nor has none";
}

TEST(MeasurementCorrelation, ofScansMoreThanASecondApartCountOncePerScanAtRest)
{
  MeasurementCorrelation slow;
  for (int i = 0; i < 3; ++i) slow.add(Timestamp(i * 1500ms), Eigen::Vector3d::Zero());
  EXPECT_EQ(slow.registrationsPerTravelOrRest(kLength), 1);
}
}  // namespace scanloom::measurement_correlation_unittest
