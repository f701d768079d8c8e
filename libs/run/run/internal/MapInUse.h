/** A drive in the map of an earlier one: searched beside the run until it is found, and again where it is lost. */
#pragma once
#include "estimation/slam/LidarInertialSlam.h"
#include "estimation/slam/PlaceSearch.h"
#include "run/run/GivenMap.h"

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scanloom
{
class MapInUse
{
 public:
  MapInUse(const GivenMap&, const SlamSettings&, const std::vector<MountedLidar>&);

  /**
   * All estimates since the last call. Where they are in the map, by a keyframe a second ago or more: the caller makes
   * the entry, so that the next ones are in the map's frame. The time from keyframe to entry is that of the scans and
   * does not depend on threads.
   */
  std::optional<MapEntry> add(const std::vector<StateEstimate>&, LevelBy);

  /** There is a map, and the drive is searched in it. */
  bool isSearched() const { return map_ && !in_map_; }

  /** From the first pose until the drive was found for the first time. */
  std::optional<Duration> foundAfter() const { return found_after_; }

  /** A keyframe in the frame in which the drive began. */
  Keyframe inDrive(Keyframe) const;

  /** Why the drive is searched at its end. */
  std::string whyNotFound() const;

 private:
  using Searched = std::pair<PlaceSearch, SearchedPlace>;

  void look(const StateEstimate&, LevelBy);
  std::optional<MapEntry> taken(const StateEstimate& newest);

  std::shared_ptr<const PriorMap> map_;  // null: none is given
  std::optional<PlaceGuess> about_;      // where the drive starts
  SlamSettings settings_;
  std::vector<MountedLidar> lidars_;
  std::optional<PlaceSearch> search_;  // begun, while it rests
  std::future<Searched> running_;
  Rigid drive_T_body_searched_;  // at the keyframe for which it runs
  Timestamp taken_at_;           // when what it finds is taken
  PlaceOutcome outcome_ = PlaceOutcome::NotInMap;
  bool in_map_ = false;
  Rigid map_T_drive_;  // of the frame in which the drive began
  std::optional<Timestamp> first_;
  std::optional<Duration> found_after_;
};
}  // namespace scanloom
