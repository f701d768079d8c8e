#include "estimation/slam/PlaceSearch.h"

#include <gtest/gtest.h>

#include "StandOfStems.h"

#include <cmath>

namespace scanloom::place_search_unittest
{
namespace
{
const std::vector<MountedLidar> kLidars{{"left", Rigid::fromXyzYawPitchRoll(0, 0, 3, 0, 0, 0)}};

/** What the body sees at a place, in a frame of which it knows no more than its pose there. */
Keyframe seenAt(const Rigid& world_T_body, const Rigid& frame_T_world, const StandOfStems& stand)
{
  const Scan scan = stand.scanAt(Timestamp{0s}, [&](Timestamp) { return world_T_body; });
  return {scan.end(), frame_T_world * world_T_body, scan.points};
}

Rigid at(double x, double y, double yaw) { return Rigid::fromXyzYawPitchRoll(x, y, 0, yaw, 0, 0); }

std::shared_ptr<const PriorMap> mapOf(const StandOfStems& stand)
{
  std::vector<Keyframe> keyframes;
  for (const double x : {0, 5, 10}) keyframes.push_back(seenAt(at(x, 0, 0), Rigid::identity(), stand));
  return std::make_shared<const PriorMap>(keyframes, kLidars, SlamSettings{});
}

const Rigid kMapTDrive = at(7, -2, 2.1);
}  // namespace

TEST(PlaceSearch, findsADriveByTwoKeyframesThatAgree)
{
  const StandOfStems stand;
  PlaceSearch search(mapOf(stand), {}, kLidars);
  const Rigid first = at(2, 1, 2.3), second = at(5, 2, 2.4);
  EXPECT_EQ(search.add(seenAt(first, kMapTDrive.inverse(), stand)).outcome, PlaceOutcome::Unconfirmed);
  const SearchedPlace found = search.add(seenAt(second, kMapTDrive.inverse(), stand));
  ASSERT_EQ(found.outcome, PlaceOutcome::Found);
  EXPECT_LT(boxMinus(found.place->map_T_body, second).norm(), 0.05);
  EXPECT_LT(boxMinus(found.place->map_T_drive, kMapTDrive).norm(), 0.1);
}

TEST(PlaceSearch, findsADriveByOneKeyframeWhereItIsKnownAbout)
{
  const StandOfStems stand;
  const Rigid place = at(2, 1, 2.3), about = at(4, 0, 2.6);
  PlaceSearch search(mapOf(stand), {}, kLidars, PlaceGuess{about});
  EXPECT_EQ(search.add(seenAt(place, kMapTDrive.inverse(), stand)).outcome, PlaceOutcome::Found);
}

TEST(PlaceSearch, findsNoPlaceInAnotherStand)
{
  PlaceSearch search(mapOf(StandOfStems(1)), {}, kLidars);
  for (const double x : {0, 4, 8})
    EXPECT_EQ(search.add(seenAt(at(x, 0, 0), Rigid::identity(), StandOfStems(2))).outcome, PlaceOutcome::NotInMap);
}
}  // namespace scanloom::place_search_unittest
