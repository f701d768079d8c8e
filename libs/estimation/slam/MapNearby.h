/** The map of an earlier drive, for those who show a drive in it: keyframe by keyframe, as the body comes near. */
#pragma once
#include "estimation/slam/PriorMap.h"
#include "estimation/slam/StateEstimate.h"

#include <memory>
#include <optional>
#include <vector>

namespace scanloom
{
class MapNearby
{
 public:
  /** Null: there is no map. */
  explicit MapNearby(std::shared_ptr<const PriorMap>);

  /**
   * A keyframe of the map within 60 m of the body that was not given since the map was entered, its points the means of
   * its cells. None while the estimate is not in the map.
   */
  std::optional<Keyframe> next(const StateEstimate&);

 private:
  std::shared_ptr<const PriorMap> map_;
  std::vector<bool> given_;  // by keyframe
};
}  // namespace scanloom
