#include "diagnosis/internal/LidarCheck.h"

#include "calibration/seenInWorld.h"

#include <gmock/gmock.h>

#include <map>

namespace scanloom::lidar_check_unittest
{
namespace
{
/** Where two lidars look from, and where they are believed to. */
struct Rig
{
  Rigid left = at(0.3, 1, 0.5, 30, 15, -25), right = at(0.3, -1, 0.5, -30, 15, 25);
  Rigid believed_left = left, believed_right = right;
};

Keyframe keyframe(const Rig& rig, int number)
{
  const Rigid world_T_body = at(4.0 * number, 0, 0, 5.0 * number);
  const auto seed = static_cast<std::uint64_t>(number);
  PointCloud left = seen(forest(10), world_T_body, rig.left, rig.believed_left, seed);
  PointCloud right = seen(forest(10), world_T_body, rig.right, rig.believed_right, 100 + seed);
  for (std::size_t i = 0; i < right.size(); ++i) right.sensor_id[i] = 1;
  left.append(right);
  return {Timestamp(number * 4s), world_T_body, left};
}

/** By "<lidar> <measure>", after a drive past `keyframes`. */
std::map<std::string, Finding> findingsOf(const Rig& rig, int keyframes = 4)
{
  LidarCheck check({{"left", rig.believed_left}, {"right", rig.believed_right}});
  for (int k = 0; k < keyframes; ++k) check.add(keyframe(rig, k));
  std::map<std::string, Finding> findings;
  for (const Finding& finding : check.compare()) findings[finding.about + ' ' + finding.measure] = finding;
  return findings;
}
}  // namespace

TEST(LidarCheck, findsNothingWrongWithARigThatIsRight)
{
  const auto findings = findingsOf({});
  EXPECT_EQ(findings.size(), 3u);
  for (const auto& [name, finding] : findings) EXPECT_EQ(finding.verdict, Verdict::Ok) << name << ' ' << finding.says;
}

TEST(LidarCheck, namesTheLidarThatIsTurnedOrMovedAndByHowMuch)
{
  Rig turned;
  turned.believed_right = at(0.3, -1, 0.5, -28, 15, 25);
  const Finding turn = findingsOf(turned).at("right pose");
  EXPECT_EQ(turn.verdict, Verdict::Warning);
  EXPECT_THAT(turn.mend, testing::HasSubstr("-2.0) deg"));

  Rig off;
  off.believed_right = at(0.8, -1, 0.5, -30, 15, 25);
  const Finding offset = findingsOf(off).at("right pose");
  EXPECT_EQ(offset.verdict, Verdict::NotFit);
  EXPECT_THAT(offset.mend, testing::HasSubstr("move the sensor by (-0.50"));
}

TEST(LidarCheck, namesTheLidarThatIsMountedTheOtherWayRoundAndDoesNotBlameTheOther)
{
  Rig rig;
  rig.believed_left = rig.left * at(0, 0, 0, 180);
  const auto findings = findingsOf(rig);
  EXPECT_EQ(findings.at("left steadiness").verdict, Verdict::Warning);
  EXPECT_EQ(findings.at("right steadiness").verdict, Verdict::Ok);
  EXPECT_EQ(findings.count("right pose"), 0u);
}

TEST(LidarCheck, saysNothingOfARigThatIsRightBeforeTheMachineHasDriven)
{
  EXPECT_TRUE(findingsOf({}, 0).empty());
  EXPECT_TRUE(findingsOf({}, 1).empty());
}

TEST(LidarCheck, namesTheLidarWhoseGroundIsUprightBeforeTheMachineHasDriven)
{
  Rig lying;
  lying.believed_left = at(0.3, 1, 0.5, 30, 15, 60);
  const auto findings = findingsOf(lying, 1);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings.at("left ground").verdict, Verdict::NotFit);
}

TEST(LidarCheck, namesBothOfTwoExchangedLidarsBeforeTheMachineHasDriven)
{
  Rig exchanged;
  std::swap(exchanged.believed_left, exchanged.believed_right);
  const auto findings = findingsOf(exchanged, 1);
  EXPECT_GE(findings.at("left ground").verdict, Verdict::Warning);
  EXPECT_GE(findings.at("right ground").verdict, Verdict::Warning);
}

TEST(LidarCheck, takesAGroundThatBothLidarsSeeTiltedForASlope)
{
  Rig sloping;
  sloping.believed_left = at(0, 0, 0, 0, 30, 0) * sloping.left;
  sloping.believed_right = at(0, 0, 0, 0, 30, 0) * sloping.right;
  EXPECT_TRUE(findingsOf(sloping, 1).empty());
}

TEST(LidarCheck, comparesWhatLidarsSeeInTheSameScansBeforeThereAreThreeKeyframes)
{
  const auto poseOf = [](const Rig& rig)
  {
    LidarCheck check({{"left", rig.believed_left}, {"right", rig.believed_right}});
    for (int k = 0; k < 6; ++k) check.add(Scan{Timestamp(k * 1s), 100ms, {}, keyframe(rig, k).points, {}, {}});
    return check.compare().at(0);
  };
  EXPECT_EQ(poseOf({}).verdict, Verdict::Ok) << poseOf({}).says;
  Rig turned;
  turned.believed_right = at(0.3, -1, 0.5, -27, 15, 25);
  const Finding turn = poseOf(turned);
  EXPECT_EQ(turn.about, "right");
  EXPECT_GE(turn.verdict, Verdict::Warning);
  EXPECT_THAT(turn.mend, testing::HasSubstr("-3.0) deg"));
}

TEST(LidarCheck, aBonnetIsTheMachineThoughOthersSeeThePlaceWhereItWas)
{
  const Rigid pose = at(0, 0, 0.5);
  LidarCheck check({{"top", pose}});
  for (int k = 0; k < 8; ++k)
  {
    const Rigid world_T_body = at(4.0 * k, 0, 0);
    RayWorld world = forest(3, 400);
    world.stems.push_back({{4.0 * k - 1.2, 0}, 0.6});
    check.add(Keyframe{Timestamp(k * 4s), world_T_body,
                       seen(world, world_T_body, pose, pose, static_cast<std::uint64_t>(k))});
  }
  EXPECT_EQ(check.crop().verdict, Verdict::Warning) << check.crop().says;
}

TEST(LidarCheck, judgesByThreeKeyframesBecauseTwoDoNotTellHowSureTheyAre)
{
  EXPECT_TRUE(findingsOf({}, 2).empty());
  EXPECT_EQ(findingsOf({}, 3).count("left steadiness"), 1u);
  EXPECT_EQ(findingsOf({}, 3).count("right pose"), 1u);
}
}  // namespace scanloom::lidar_check_unittest
