#include "estimation/slam/internal/requireGravity.h"

#include <gmock/gmock.h>

#include <stdexcept>

#include "support/messageOf.h"

namespace scanloom::require_gravity_unittest
{
using testing::HasSubstr;

namespace
{
std::vector<ImuSample> atRest(const Eigen::Vector3d& force)
{
  return std::vector<ImuSample>(5, {Timestamp{}, Eigen::Vector3d::Zero(), force});
}

std::string refusalOf(const Eigen::Vector3d& force)
{
  return messageOf<std::runtime_error>([&] { requireGravity(atRest(force), {}); });
}
}  // namespace

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
}  // namespace scanloom::require_gravity_unittest
