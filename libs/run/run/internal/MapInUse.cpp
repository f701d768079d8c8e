#include "run/run/internal/MapInUse.h"

#include "estimation/graph/PosePriorFactor.h"

namespace scanloom
{
namespace
{
/** From a keyframe until its place is taken: longer than a search takes, which grows with the map. */
Duration timeToSearch(const PriorMap& map) { return 1s + 20ms * map.keyframes().size(); }
}  // namespace

MapInUse::MapInUse(const GivenMap& given, const SlamSettings& settings, const std::vector<MountedLidar>& lidars)
  : map_(given.map), settings_(settings), lidars_(lidars)
{
  if (given.map_T_body) about_ = PlaceGuess{*given.map_T_body};
}

std::optional<MapEntry> MapInUse::add(const std::vector<StateEstimate>& estimates, LevelBy level)
{
  if (!map_ || estimates.empty()) return std::nullopt;
  if (!first_) first_ = estimates.front().stamp;
  const StateEstimate& newest = estimates.back();
  in_map_ = newest.in_map;  // LOST for long, a drive leaves the map
  std::optional<MapEntry> entry;
  if (running_.valid() && newest.stamp >= taken_at_) entry = taken(newest);
  for (const StateEstimate& estimate : estimates)
    if (!in_map_ && estimate.keyframe) look(estimate, level);
  return entry;
}

/** One search at a time: of a keyframe that comes while another one is searched, the scans are not needed. */
void MapInUse::look(const StateEstimate& estimate, LevelBy level)
{
  if (running_.valid()) return;
  if (!search_) search_ = PlaceSearch(map_, settings_, lidars_, found_after_ ? std::nullopt : about_, level);
  drive_T_body_searched_ = estimate.map_T_body;
  taken_at_ = estimate.stamp + timeToSearch(*map_);
  running_ = std::async(
      std::launch::async,
      [](PlaceSearch search, const Keyframe& keyframe)
      {
        SearchedPlace found = search.add(keyframe);
        return Searched{std::move(search), std::move(found)};
      },
      std::move(*search_), *estimate.keyframe);
  search_.reset();
}

std::optional<MapEntry> MapInUse::taken(const StateEstimate& newest)
{
  Searched searched = running_.get();
  search_ = std::move(searched.first);
  outcome_ = searched.second.outcome;
  if (outcome_ != PlaceOutcome::Found) return std::nullopt;
  search_.reset();
  in_map_ = true;
  const FoundPlace& place = *searched.second.place;
  map_T_drive_ = place.map_T_drive * map_T_drive_;
  if (!found_after_) found_after_ = newest.stamp - *first_;
  return MapEntry{map_, place.map_T_drive,
                  movedTo(drive_T_body_searched_.inverse() * newest.map_T_body, place.covariance)};
}

Keyframe MapInUse::inDrive(Keyframe keyframe) const
{
  keyframe.map_T_body = map_T_drive_.inverse() * keyframe.map_T_body;
  return keyframe;
}

std::string MapInUse::whyNotFound() const
{
  if (found_after_) return "LOST in the map, and not found in it again: the last poses are by the IMU, or in a new map";
  return outcome_ == PlaceOutcome::LookAlike
             ? "two places in this map look alike: the poses are in a frame of their own"
             : "not in this map: the poses are in a frame of their own";
}
}  // namespace scanloom
