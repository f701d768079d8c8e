#include "site/Site.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/maps/OctoMapExport.h"
#include "mrpt/maps/OctoMapFile.h"
#include "mrpt/maps/SimpleMapReader.h"
#include "site/DriveOfStems.h"
#include "site/GnssOfRawlog.h"
#include "site/SiteFiles.h"
#include "support/TemporaryFolder.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

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

TEST_F(SiteOfStems, aStemThatWasFelledSinceIsGoneFromTheMap)
{
  constexpr int kFelled = 39;  // beside the way
  const Eigen::Vector2d stem = StandOfStems().stems()[kFelled];
  add({straight(-10, 0, 6)});
  DriveOfStems later{straight(-8, 1, 6)};
  later.start = Timestamp{9000s};
  add(later, StandOfStems(1, kFelled));
  const Site made = site();
  const SiteMap map = writeSite(folder.path(), made, drives, {}, [](double) {});
  ASSERT_EQ(map.gone.size(), 1U);
  const Eigen::Vector3d& foot = map.gone[0].foot;  // in the first drive's frame, which began at x = -10
  EXPECT_LT((foot.head<2>() + Eigen::Vector2d(-10, 0) - stem).norm(), 0.3);
  EXPECT_GT(map.gone[0].height, 3) << "few rays pass above";
  EXPECT_EQ(map.gone[0].gone_by, 1U);

  const SimpleMapReader reader(folder / "keyframes.simplemap");
  int beside = 0, all = 0;
  for (std::size_t i = 0; i < reader.size(); ++i)
  {
    const Keyframe keyframe = reader.keyframe(i);
    for (std::size_t k = 0; k < keyframe.points.size(); ++k)
    {
      const Eigen::Vector3d p = keyframe.map_T_body * keyframe.points.position(k).cast<double>().eval();
      beside += (p - foot).head<2>().norm() < 0.4 && p.z() > foot.z() + 0.3 && p.z() < foot.z() + map.gone[0].height;
      ++all;
    }
  }
  EXPECT_LT(beside, 7 * 120 * map.gone[0].height / 6 / 4) << "a quarter of what the first drive saw there";
  EXPECT_GT(all, 100000);
}

TEST_F(SiteOfStems, nothingIsGoneWhereNothingWasFelled)
{
  add({straight(-10, 0, 6)});
  DriveOfStems later{straight(-8, 1, 6)};
  later.start = Timestamp{9000s};
  add(later);
  EXPECT_TRUE(writeSite(folder.path(), site(), drives, {}, [](double) {}).gone.empty());
}

TEST_F(SiteOfStems, tilesTogetherHaveAllThatIsKnown)
{
  add({straight(-10, 0, 6)});
  const Site made = site();
  const SiteMap map = writeSite(folder.path(), made, drives, {}, [](double) {});
  OctoMapBuilder whole(octoMapPreset("preview"), {Rigid::fromXyzYawPitchRoll(0, 0, 3, 0, 0, 0)});
  const SimpleMapReader reader(folder / "keyframes.simplemap");
  for (std::size_t i = 0; i < reader.size(); ++i) whole.add(reader.keyframe(i));
  std::uint64_t in_tiles = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder / "tiles"))
    in_tiles += occupiedVoxels(*readOctoMap(file.path()));
  EXPECT_GE(map.tiles, 4U);
  EXPECT_EQ(in_tiles, occupiedVoxels(whole.tree()));
}

TEST_F(SiteOfStems, pointsAreInTheCoordinatesOfACountry)
{
  add({straight(-10, 0, 6)});
  SiteFrame frame{Geodetic{62.0833, 27, 100}, std::nullopt};
  frame.grid.emplace("EPSG:3067");
  Site made = site();
  writeSite(folder.path(), made, drives, frame, [](double) {});
  ASSERT_FALSE(std::filesystem::exists(folder / "tiles" / "0_0.las")) << "no reference says where it is";
  made.pieces[0].is_in_reference_frame = true;
  writeSite(folder.path(), made, drives, frame, [](double) {});
  std::ifstream las(folder / "tiles" / "0_0.las", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(las), {}};
  const auto at = [&](std::size_t place)
  {
    double value = 0;
    std::memcpy(&value, bytes.data() + place, sizeof value);
    return value;
  };
  constexpr std::size_t kMostX = 179, kLeastX = 187, kMostY = 195, kLeastY = 203;  // of the header (LAS 1.4, table 3)
  // The tile is east and north of the origin, which lies on the grid's meridian: its scale is 0.9996 there.
  EXPECT_NEAR(at(kLeastX), 500000, 0.5);
  EXPECT_NEAR(at(kMostX), 500000 + 0.9996 * 51.2, 0.5);
  const double north = CountryGrid("EPSG:3067").of({62.0833, 27, 100}).y();
  EXPECT_GE(at(kLeastY), north - 0.01);
  EXPECT_LE(at(kMostY), north + 0.9996 * 51.2 + 0.01);
}

TEST_F(SiteOfStems, fixesOfARawlogAreAReference)
{
  const Geodetic origin{62.0833, 27, 100};
  const std::filesystem::path file = folder / "drive.rawlog";
  {
    mrpt::io::CFileGZOutputStream stream(file.string());
    auto archive = mrpt::serialization::archiveFrom(stream);
    for (int i = 0; i < 3; ++i)
    {
      mrpt::obs::gnss::Message_NMEA_GGA gga;
      gga.fields.latitude_degrees = origin.latitude + 1e-4 * i;
      gga.fields.longitude_degrees = origin.longitude;
      gga.fields.altitude_meters = 82;
      gga.fields.geoidal_distance = 18;
      gga.fields.fix_quality = static_cast<std::uint8_t>(i == 0 ? 1 : i == 1 ? 0 : 4);
      mrpt::obs::CObservationGPS gps;
      gps.timestamp = toMrpt(Timestamp{1000s + 1s * i});
      gps.setMsg(gga);
      archive << gps;
    }
  }
  const PositionFile read = readGnssOfRawlog(file);
  ASSERT_TRUE(read.origin);
  EXPECT_NEAR(read.origin->height, 100, 1e-9) << "above the ellipsoid";
  ASSERT_EQ(read.track.size(), 2U) << "one had no fix";
  EXPECT_NEAR(read.track[1].position.y(), 2e-4 * M_PI / 180 * 6.385e6, 0.1);
  EXPECT_EQ(read.track[0].sigma, 2);
  EXPECT_EQ(read.track[1].sigma, 0.02) << "fixed RTK";
}

TEST_F(SiteOfStems, aPositionCountsAsItsFileSays)
{
  const DriveOfStems drive{straight(-20, 0, 12)};
  add(drive);
  PositionTrack track = trackOf(drive);
  for (StampedPosition& position : track) position.sigma = 0.5;
  const Site made = site({{track, kLever, {2, 0s}}});
  EXPECT_NEAR(std::sqrt(made.keyframes[6].covariance(2, 2)), 0.5 / std::sqrt(13), 0.02);
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
