/** CoVisiblePoints and CloudAgreement in worlds of stems, with poses that are wrong by a known amount. */
#include "calibration/CloudAgreement.h"

#include "base/core/So3.h"
#include "calibration/internal/CoVisiblePoints.h"
#include "calibration/seenInWorld.h"

#include <gtest/gtest.h>

namespace scanloom::cloud_agreement_unittest
{
TEST(CoVisiblePoints, ofTheSamePlaceAgreesAndOfAnotherDoesNot)
{
  const RayWorld world = forest(1);
  const Rigid left = at(0, 1, 0), right = at(0, -1, 0);
  const PointCloud a = seen(world, {}, left, left, 1), b = seen(world, {}, right, right, 2);
  const CoVisiblePoints good = commonView(a, {}, b, right);
  ASSERT_GT(good.common, 1000u);
  EXPECT_GT(static_cast<double>(good.near) / static_cast<double>(good.common), 0.85);
  const CoVisiblePoints lifted = commonView(a, at(0, 0, 0.8), b, right);
  EXPECT_LT(static_cast<double>(lifted.near) / static_cast<double>(lifted.common), 0.3);
}

namespace
{
struct Wrong
{
  const char* name;
  Rigid true_in_believed;  // how the believed pose is wrong: true = believed * this
};
void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.name; }
}  // namespace

class WrongPoses : public testing::TestWithParam<Wrong>
{
};

TEST_P(WrongPoses, areFoundByRegistrationToTheOtherLidar)
{
  const Rigid left = at(0.3, 1, 0.5, 30, 15, -25), right = at(0.3, -1, 0.5, -30, 15, 25);
  const Rigid believed = right * GetParam().true_in_believed.inverse();
  std::vector<std::vector<SeenPoints>> taken;
  for (int k = 0; k < 4; ++k)
  {
    const RayWorld world = forest(static_cast<std::uint64_t>(10 + k));
    std::vector<SeenPoints> snapshot(2);
    snapshot[0].points = seen(world, {}, left, left, static_cast<std::uint64_t>(k));
    snapshot[1].points = seen(world, {}, right, believed, static_cast<std::uint64_t>(100 + k));
    taken.push_back(std::move(snapshot));
  }
  std::vector<SeenByBoth> pairs;
  for (const std::vector<SeenPoints>& snapshot : taken) pairs.push_back({&snapshot[1], &snapshot[0]});

  const auto agreement = cloudAgreement(pairs, believed, left);
  ASSERT_TRUE(agreement && agreement->correction);
  const Eigen::Vector3d offset = right.translation - believed.translation;
  const Eigen::Vector3d rotation = logSo3(right.rotation * believed.rotation.conjugate());
  EXPECT_LT((agreement->correction->offset - offset).norm(), 0.03);
  EXPECT_LT((agreement->correction->rotation - rotation).norm() / kDegree, 0.3);
  EXPECT_GT(agreement->correction->near_share, 0.85);
}

INSTANTIATE_TEST_SUITE_P(FromNoneToFiveDegreesAndThirtyCentimetres, WrongPoses,
                         testing::Values(Wrong{"none", {}}, Wrong{"yaw", at(0, 0, 0, 5)},
                                         Wrong{"roll and forward", at(0.3, 0, 0, 0, 0, 5)},
                                         Wrong{"sideways", at(0, 0.3, 0)},
                                         Wrong{"all", at(-0.2, 0.15, 0.15, 3, -3, 2)}),
                         [](const auto& wrong)
                         {
                           std::string name = wrong.param.name;
                           for (char& c : name)
                             if (c == ' ') c = '_';
                           return name;
                         });

TEST(CloudAgreement, ofLidarsThatSeeNothingInCommonIsNone)
{
  const Rigid pose;
  std::vector<SeenPoints> snapshot(2);
  snapshot[0].points = seen(forest(1), {}, pose, pose, 1);
  EXPECT_FALSE(cloudAgreement({{&snapshot[1], &snapshot[0]}}, pose, pose));
  EXPECT_FALSE(cloudAgreement({}, pose, pose));
}
}  // namespace scanloom::cloud_agreement_unittest
