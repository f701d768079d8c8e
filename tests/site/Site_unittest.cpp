#include "site/Site.h"

#include "site/DriveOfStems.h"
#include "site/SiteFiles.h"
#include "support/TemporaryFolder.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

namespace scanloom::site_unittest
{
namespace
{
using testing::HasSubstr;

struct SiteOfStems : testing::Test
{
  TemporaryFolder folder;
  std::vector<SiteDrive> drives;
  std::vector<DriveOfStems> truths;

  void add(const DriveOfStems& drive, const StandOfStems& stand = StandOfStems())
  {
    const std::filesystem::path in = folder / ("drive" + std::to_string(drives.size()));
    drive.write(in, stand);
    drives.emplace_back(in);
    truths.push_back(drive);
  }

  Site site(const std::vector<Reference>& references = {}) const
  {
    return madeOf(drives, SlamSettings{}, references, [](double) {});
  }

  const Rigid& truthOf(const SiteKeyframe& keyframe) const
  {
    return truths[keyframe.drive].world_T_body[keyframe.index];
  }

  /** m, of all keyframes of a piece, the first of which is taken as right; or in the world itself. */
  double farthestOff(const Site& site, std::size_t piece, bool in_world = false) const
  {
    const std::vector<std::size_t>& keyframes = site.pieces[piece].keyframes;
    const SiteKeyframe& first = site.keyframes[keyframes.front()];
    const Rigid world_T_site = in_world ? Rigid::identity() : truthOf(first) * first.site_T_body.inverse();
    double most = 0;
    for (const std::size_t i : keyframes)
      most = std::max(
          most,
          (world_T_site * site.keyframes[i].site_T_body.translation - truthOf(site.keyframes[i]).translation).norm());
    return most;
  }

  int accepted(const Site& site) const
  {
    return static_cast<int>(std::count_if(site.loops.begin(), site.loops.end(),
                                          [](const Loop& loop) { return loop.decision == LoopDecision::Accepted; }));
  }
};

const Eigen::Vector3d kLever(-1, 0.5, 4);

/** What a total station sees of a drive; the stand's world is its frame. */
PositionTrack trackOf(const DriveOfStems& drive)
{
  PositionTrack track;
  for (std::size_t i = 0; i < drive.world_T_body.size(); ++i)
    track.push_back({drive.stampOf(i), drive.world_T_body[i] * kLever});
  return track;
}
}  // namespace

TEST_F(SiteOfStems, aDriveThatComesBackLosesItsDrift)
{
  DriveOfStems drive{thereAndBack(-10, 7)};
  drive.turn_error = 3e-3;
  add(drive);
  const Rigid first_T_last = drive.world_T_body.front().inverse() * drive.world_T_body.back();
  const Eigen::Vector3d drift = drive.estimated().back().translation - first_T_last.translation;
  ASSERT_GT(drift.norm(), 0.3);
  const Site made = site();
  ASSERT_EQ(made.pieces.size(), 1U);
  EXPECT_GE(accepted(made), 3);
  const Rigid closed = made.keyframes.front().site_T_body.inverse() * made.keyframes.back().site_T_body;
  EXPECT_LT((closed.translation - first_T_last.translation).norm(), 0.05);
  const SiteKeyframe& last = made.keyframes.back();
  EXPECT_LT(std::sqrt(last.covariance(0, 0)), 0.05);
}

TEST_F(SiteOfStems, aDriveOnAnotherDayIsFoundAndHasTheFrameOfTheFirst)
{
  add({straight(-10, 0, 6)});
  DriveOfStems other{straight(-4, 2, 6)};
  other.start = Timestamp{9000s};
  std::reverse(other.world_T_body.begin(), other.world_T_body.end());
  add(other);
  const Site made = site();
  ASSERT_EQ(made.pieces.size(), 1U);
  EXPECT_LT(farthestOff(made, 0), 0.05);
}

TEST_F(SiteOfStems, drivesOfOtherStandsArePiecesOfTheirOwn)
{
  add({straight(-10, 0, 4)}, StandOfStems(1));
  add({straight(-10, 0, 3)}, StandOfStems(2));
  const Site made = site();
  ASSERT_EQ(made.pieces.size(), 2U);
  EXPECT_EQ(made.pieces[0].keyframes.size(), 5U) << "the largest first";
  EXPECT_EQ(accepted(made), 0);
}

TEST_F(SiteOfStems, whatADriveSawAfterItWasLostIsFoundInWhatItSawBefore)
{
  DriveOfStems drive{thereAndBack(-10, 4)};
  drive.lost_at = 6;
  drive.lost_T_found = Rigid::fromXyzYawPitchRoll(7, -5, 0, 0.8, 0, 0);
  add(drive);
  const Site made = site();
  ASSERT_EQ(made.pieces.size(), 1U);
  EXPECT_LT(farthestOff(made, 0), 0.06);
}

TEST_F(SiteOfStems, aReferenceGivesItsFrameAndBendsTheDriveStraight)
{
  DriveOfStems drive{straight(-20, 0, 12)};
  drive.turn_error = 2e-3;
  add(drive);
  const Site made = site({{trackOf(drive), kLever}});
  ASSERT_TRUE(made.pieces[0].is_in_reference_frame);
  EXPECT_LT(farthestOff(made, 0, true), 0.02);
}

TEST_F(SiteOfStems, drivesWithoutACommonPlaceHangTogetherByTheReference)
{
  const DriveOfStems west{straight(-28, 0, 4)};
  DriveOfStems east{straight(20, 10, 4)};
  east.start = Timestamp{9000s};
  add(west, StandOfStems(1));
  add(east, StandOfStems(2));
  const Site made = site({{trackOf(west), kLever}, {trackOf(east), kLever}});
  ASSERT_EQ(made.pieces.size(), 1U);
  EXPECT_LT(farthestOff(made, 0, true), 0.03);
}

TEST_F(SiteOfStems, fourPositionsTellNoFrame)
{
  const DriveOfStems drive{straight(-20, 0, 3)};
  add(drive);
  EXPECT_FALSE(site({{trackOf(drive), kLever}}).pieces[0].is_in_reference_frame);
}

TEST_F(SiteOfStems, positionsWhoseErrorsLastCountAsOne)
{
  const DriveOfStems drive{straight(-20, 0, 12)};  // a position every 10 s
  add(drive);
  const auto sigmaWith = [&](Duration lasting) {
    return std::sqrt(site({{trackOf(drive), kLever, {2, lasting}}}).keyframes[6].covariance(2, 2));
  };
  EXPECT_NEAR(sigmaWith(0s), 2 / std::sqrt(13), 0.05);
  EXPECT_NEAR(sigmaWith(20s) / sigmaWith(0s), std::sqrt(3), 0.15);
}

TEST_F(SiteOfStems, positionsOfAnotherPrismAreNotUsed)
{
  const DriveOfStems drive{straight(-20, 0, 12)};
  add(drive);
  PositionTrack track = trackOf(drive);
  for (std::size_t i = 4; i < 7; ++i) track[i].position += Eigen::Vector3d(5, 30, 0);
  const Site made = site({{track, kLever}});
  EXPECT_LT(farthestOff(made, 0, true), 0.03);
  for (const ReferencePosition& position : made.references)
    EXPECT_EQ(position.used, position.keyframe < 4 || position.keyframe >= 7) << position.keyframe;
}

TEST_F(SiteOfStems, aReferenceOfAnotherDriveIsNotUsed)
{
  const DriveOfStems drive{straight(-20, 0, 12)};
  add(drive);
  DriveOfStems circle = drive;
  for (std::size_t i = 0; i < circle.world_T_body.size(); ++i)
    circle.world_T_body[i] = Rigid::fromXyzYawPitchRoll(9 * std::cos(1.7 * i), 9 * std::sin(1.7 * i), 0, 0, 0, 0);
  const Site made = site({{trackOf(circle), kLever}});
  EXPECT_FALSE(made.pieces[0].is_in_reference_frame);
  for (const ReferencePosition& position : made.references) EXPECT_FALSE(position.used);
}

TEST_F(SiteOfStems, isTheSameToTheBitAtEachRun)
{
  DriveOfStems drive{thereAndBack(-10, 6)};
  drive.turn_error = 3e-3;
  add(drive);
  const Site first = site(), second = site();
  for (std::size_t i = 0; i < first.keyframes.size(); ++i)
    EXPECT_EQ(boxMinus(first.keyframes[i].site_T_body, second.keyframes[i].site_T_body).norm(), 0);
}

TEST_F(SiteOfStems, posesBetweenKeyframesMoveWithBoth)
{
  DriveOfStems drive{thereAndBack(-10, 7)};
  drive.turn_error = 3e-3;
  add(drive);
  const Site made = site();
  const Trajectory trajectory = trajectoryIn(made, drives, 0);
  ASSERT_EQ(trajectory.size(), made.keyframes.size());
  for (std::size_t i = 0; i < trajectory.size(); ++i)
    EXPECT_LT(boxMinus(trajectory[i].map_T_body, made.keyframes[i].site_T_body).norm(), 1e-8);
}

TEST_F(SiteOfStems, foldersThatAreNoDriveSayWhatIsMissing)
{
  EXPECT_THAT(messageOf([&] { SiteDrive{folder.path()}; }), HasSubstr("has no keyframes.simplemap"));
  add({straight(0, 0, 2)});
  const std::filesystem::path table = folder / "drive0" / "keyframes.csv";
  std::filesystem::remove(table);
  EXPECT_THAT(messageOf([&] { SiteDrive{folder / "drive0"}; }), HasSubstr("has no keyframes.csv"));
  std::ofstream(table) << "stamp_ns\n";
  EXPECT_THAT(messageOf([&] { SiteDrive{folder / "drive0"}; }), HasSubstr("of several drives (--grow)"));
  std::ofstream(table) << "stamp_ns\n1000,0,nan\n";
  EXPECT_THAT(messageOf([&] { SiteDrive{folder / "drive0"}; }), HasSubstr("keyframes.csv:2: is no row"));
}
}  // namespace scanloom::site_unittest
