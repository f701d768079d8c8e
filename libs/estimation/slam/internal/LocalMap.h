/** The last keyframes (paper, section 2.2), or those nearby, as one NDT map; in a map of an earlier drive, with its
 * keyframes nearby. */
#pragma once
#include "base/core/Field.h"
#include "base/core/Rigid.h"
#include "estimation/ndt/NdtMap.h"
#include "estimation/slam/internal/MapDriftModel.h"

#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace scanloom
{
class PriorMap;

struct LocalMapOptions
{
  double keyframe_distance = 4.0;
  int keyframes = 12;
  double radius = 0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.keyframe_distance,
          Field{"keyframe_distance", "m", "distance from the last keyframe at which a new one is added", above(0)});
    visit(o.keyframes, Field{"keyframes", "", "number of keyframes in the map", atLeast(1)});
    visit(o.radius, Field{"radius", "m",
                          "the map holds all keyframes within this distance of the newest, also those of earlier "
                          "passes, instead of the last ones; 0: the last ones",
                          atLeast(0)});
  }
};

class LocalMap
{
 public:
  /** `prior`: the map of an earlier drive, in the same frame; none: there is none. */
  LocalMap(const LocalMapOptions&, const NdtOptions&, std::shared_ptr<const PriorMap> prior = nullptr);

  /**
   * The body is far enough from the newest keyframe for another one; always if there is none. In the map of an earlier
   * drive: from all keyframes, its own and that drive's.
   */
  bool wants(const Rigid& map_T_body) const;

  /** Takes up the nearest keyframes of the earlier drive's map instead of others, once the place is 2 m from the last.
   */
  void moveTo(const Eigen::Vector3d& place);

  /** Also gives up the map of an earlier drive. */
  void clear();

  /**
   * Adds a keyframe and removes those that no longer belong to the map. `alignment`: covariance of the pose within the
   * map, tangent of boxPlus. Returns how far the map, as the newest keyframe sees it, may have moved by that: the
   * covariance of the change of its error, as a step (m, rad) of a body at the map's origin.
   */
  Matrix6d add(const std::vector<View>& seen_from_body, const Rigid& map_T_body, const Matrix6d& alignment);

  bool empty() const { return keyframes_.empty() && of_prior_.empty(); }

  /** Whether registrations are in the frame of an earlier drive's map. */
  bool isInPriorMap() const { return prior_ != nullptr; }

  /** Of a body there by errors of the earlier drive's map, in which the map must be. */
  Matrix6d covarianceOfPrior(const Rigid& map_T_body) const;

  /** Where the oldest keyframe of the map is; there must be one. */
  const Eigen::Vector3d& oldest() const;
  const NdtMap& ndt() const { return ndt_; }

 private:
  struct Keyframe
  {
    Rigid map_T_body;
    BinnedPoints points;  // in the map frame
    ErrorShares error;    // of its pose; the first one has none
    bool in_map = false;
  };

  ErrorShares errorOfMap() const;
  bool belongs(const Keyframe&, std::size_t age) const;

  LocalMapOptions options_;
  std::deque<Keyframe> keyframes_;
  MapDriftModel errors_;
  ErrorShares map_error_;  // of what the newest keyframe sees
  NdtMap ndt_;
  std::shared_ptr<const PriorMap> prior_;
  std::vector<std::size_t> of_prior_;        // its keyframes that are in the map, in increasing order
  std::optional<Eigen::Vector3d> moved_to_;  // where these were the nearest
};
}  // namespace scanloom
