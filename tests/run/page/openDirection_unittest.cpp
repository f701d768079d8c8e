#include "run/page/internal/openDirection.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scanloom::open_direction_unittest
{
namespace
{
std::string nameOf(const std::vector<Vector6d>& directions)
{
  RegistrationResult registration;
  registration.degenerate_directions = directions;
  StateEstimate estimate;
  estimate.registration = registration;
  return openDirection(estimate);
}

/** Along x and y of the body. */
Vector6d horizontal(double x, double y)
{
  Vector6d direction = Vector6d::Zero();
  direction.head<2>() << x, y;
  return direction.normalized();
}
}  // namespace

TEST(openDirection, namesAxesOfTheBody)
{
  EXPECT_EQ(nameOf({Vector6d::Unit(0)}), "open ahead");
  EXPECT_EQ(nameOf({-Vector6d::Unit(1), Vector6d::Unit(5)}), "open sideways, in heading");
  EXPECT_EQ(nameOf({Vector6d::Unit(2)}), "open upwards");
  EXPECT_EQ(nameOf({Vector6d::Unit(4)}), "open in tilt");
}

TEST(openDirection, namesALineBetweenTwoAxes)
{
  EXPECT_EQ(nameOf({horizontal(1, 1)}), "open ahead to the left");
  EXPECT_EQ(nameOf({horizontal(-1, 1)}), "open ahead to the right");
}

TEST(openDirection, isTheSameForEveryBasisOfWhatIsOpen)
{
  for (double angle = 0; angle < M_PI; angle += 0.1)
    EXPECT_EQ(nameOf({horizontal(std::cos(angle), std::sin(angle)), horizontal(-std::sin(angle), std::cos(angle))}),
              "open ahead, sideways");
}

TEST(openDirection, saysWhyElseAScanIsNotTrusted)
{
  StateEstimate estimate;
  EXPECT_EQ(openDirection(estimate), "no points to register");
  estimate.registration.emplace();
  estimate.registration->outcome = Outcome::LowOverlap;
  EXPECT_EQ(openDirection(estimate), "little in view is known");
  estimate.registration->outcome = Outcome::Converged;
  EXPECT_EQ(openDirection(estimate), "the scan contradicts the IMU");
  estimate.trusted = true;
  EXPECT_EQ(openDirection(estimate), "lidars and IMU are apart");
}
}  // namespace scanloom::open_direction_unittest
