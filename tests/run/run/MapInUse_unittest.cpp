#include "run/run/internal/MapInUse.h"

#include <gtest/gtest.h>

#include "estimation/slam/StandOfStems.h"

namespace scanloom::map_in_use_unittest
{
namespace
{
const std::vector<MountedLidar> kLidars{{"left", Rigid::fromXyzYawPitchRoll(0, 0, 3, 0, 0, 0)}};

Rigid at(double x, double y, double yaw) { return Rigid::fromXyzYawPitchRoll(x, y, 0, yaw, 0, 0); }

/** A body that sees stems, and whose frame is where it is wherever an entry moves it to. */
struct Drive
{
  StandOfStems stand{};
  Rigid frame_T_world = at(7, -2, 2.1).inverse();

  Keyframe seenAt(const Rigid& world_T_body, Timestamp stamp, const Rigid& frame) const
  {
    const Scan scan = stand.scanAt(Timestamp{0s}, [&](Timestamp) { return world_T_body; });
    return {stamp, frame * world_T_body, scan.points};
  }

  StateEstimate estimateAt(double x, Timestamp stamp, bool in_map) const
  {
    StateEstimate estimate;
    estimate.stamp = stamp;
    estimate.in_map = in_map;
    estimate.keyframe = seenAt(at(x, 1, 0), stamp, frame_T_world);
    estimate.map_T_body = estimate.keyframe->map_T_body;
    return estimate;
  }

  GivenMap map() const
  {
    std::vector<Keyframe> keyframes;
    for (const double x : {0, 5, 10}) keyframes.push_back(seenAt(at(x, 0, 0), Timestamp{0s}, Rigid::identity()));
    return {std::make_shared<const PriorMap>(keyframes, kLidars, SlamSettings{}), std::nullopt};
  }
};
}  // namespace

TEST(MapInUse, entersTheMapASecondAfterTheKeyframeAndAgainWhereItWasLeft)
{
  Drive drive;
  const GivenMap given = drive.map();
  MapInUse map(given, {}, kLidars);
  EXPECT_FALSE(map.add({drive.estimateAt(2, Timestamp{0s}, false)}, LevelBy::Imu));
  EXPECT_FALSE(map.add({drive.estimateAt(4, Timestamp{2s}, false)}, LevelBy::Imu)) << "one keyframe is no proof";
  EXPECT_FALSE(map.add({drive.estimateAt(4, Timestamp{3s}, false)}, LevelBy::Imu))
      << "less than a second after the second keyframe";
  const auto entry = map.add({drive.estimateAt(6, Timestamp{4s}, false)}, LevelBy::Imu);
  ASSERT_TRUE(entry);
  EXPECT_LT(boxMinus(entry->map_T_drive * drive.frame_T_world, Rigid::identity()).norm(), 0.05);
  EXPECT_EQ(map.foundAfter(), 4s);
  EXPECT_FALSE(map.isSearched());

  // Lost for long: the frame has moved by metres when the scans begin a new map.
  drive.frame_T_world = at(3, 1, 0.2);
  EXPECT_FALSE(map.add({drive.estimateAt(6, Timestamp{5s}, true)}, LevelBy::Imu));
  EXPECT_FALSE(map.add({drive.estimateAt(3, Timestamp{60s}, false)}, LevelBy::Imu));
  EXPECT_TRUE(map.isSearched());
  EXPECT_FALSE(map.add({drive.estimateAt(6, Timestamp{62s}, false)}, LevelBy::Imu));
  const auto again = map.add({drive.estimateAt(6, Timestamp{64s}, false)}, LevelBy::Imu);
  ASSERT_TRUE(again);
  EXPECT_LT(boxMinus(again->map_T_drive * drive.frame_T_world, Rigid::identity()).norm(), 0.05);
  EXPECT_EQ(map.foundAfter(), 4s) << "for the first time";
}

TEST(MapInUse, withoutAMapIsNeverSearched)
{
  const Drive drive;
  MapInUse map({}, {}, kLidars);
  EXPECT_FALSE(map.add({drive.estimateAt(2, Timestamp{0s}, false)}, LevelBy::Imu));
  EXPECT_FALSE(map.isSearched());
}
}  // namespace scanloom::map_in_use_unittest
