/** Finds a drive in a map that another one has made, without knowing where in it the drive started. */
#pragma once
#include "estimation/slam/PriorMap.h"

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** Where a drive's frame is in a map's frame, by what its last keyframes have seen. */
struct FoundPlace
{
  Rigid map_T_drive;
  Rigid map_T_body;          // at the newest keyframe
  Matrix6d covariance;       // of map_T_body, tangent of boxPlus; with what keyframes of one drive err alike
  Matrix6d of_registration;  // the same without
};

enum class PlaceOutcome
{
  Found,
  Unconfirmed,  // by one keyframe only
  LookAlike,    // places fit about as well as each other
  NotInMap,
};

/** "found", "unconfirmed", "look alike" or "not in map". */
std::string toString(PlaceOutcome);

struct SearchedPlace
{
  PlaceOutcome outcome = PlaceOutcome::NotInMap;
  std::optional<FoundPlace> place;  // Found or Unconfirmed
  /** Score of the best place over that of the keyframes with themselves: 1 if the map were made of them. */
  double agreement = 0;
};

/** About where the body is: within `reach` (m) to each side and, from 3 m on, 30 deg of heading. */
struct PlaceGuess
{
  Rigid map_T_body;
  double reach = 6;
};

/** By what z is up in a drive's frame. */
enum class LevelBy
{
  Imu,         // to 3 deg
  Assumption,  // that the machine stood level at the start: to 12 deg
};

class PlaceSearch
{
 public:
  /** `about`: where the body is at the drive's first keyframe; none: anywhere in the map. */
  PlaceSearch(std::shared_ptr<const PriorMap>, const SlamSettings&, const std::vector<MountedLidar>&,
              const std::optional<PlaceGuess>& about = std::nullopt, LevelBy = LevelBy::Imu);

  /** A keyframe that is searched together with the ones after it. */
  void see(const Keyframe& in_drive);

  /**
   * Sees the keyframe and searches what the drive's last ones, this one included, have seen together. A place is found
   * if two keyframes have it independently, or one where the place is known about. Both frames are level.
   */
  SearchedPlace add(const Keyframe& in_drive);

 private:
  struct Seen
  {
    Rigid drive_T_body;
    std::vector<View> views;  // from the body
  };

  std::vector<View> seenFrom(const Rigid& drive_T_level) const;
  std::vector<Rigid> starts(double grid, const Rigid& drive_T_level) const;
  PlaceOutcome confirmed(const FoundPlace&, const Rigid& drive_T_body);

  std::shared_ptr<const PriorMap> map_;
  NdtOptions map_cells_, cells_;
  RegistrationOptions alignment_;
  MapLevels levels_;
  std::vector<Rigid> body_T_lidar_;
  CellCorrections corrections_;
  double lean_;  // rad, of the drive's frame in the map's, at most
  std::optional<PlaceGuess> about_;
  std::optional<Rigid> map_T_drive_about_;  // from the first keyframe on
  std::optional<Rigid> map_T_drive_;        // by the last keyframe that had a place
  std::deque<Seen> seen_;
};
}  // namespace scanloom
