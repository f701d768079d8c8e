/** The last keyframes (paper, section 2.2), or those nearby, as one NDT map. */
#pragma once
#include "core/Field.h"
#include "core/Rigid.h"
#include "ndt/NdtMap.h"
#include "slam/KeyframeErrors.h"

#include <deque>
#include <optional>

namespace scanloom
{
struct LocalMapOptions
{
  double keyframe_distance = 4.0;
  double keyframe_turn_deg = 20.0;
  int keyframes = 12;
  double radius = 0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.keyframe_distance,
          Field{"keyframe_distance", "m", "distance from the last keyframe at which a new one is added", above(0)});
    visit(o.keyframe_turn_deg,
          Field{"keyframe_turn_deg", "deg", "turn since the last keyframe at which a new one is added; 180: never",
                between(1, 180)});
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
  LocalMap(const LocalMapOptions&, const NdtOptions&);

  /** The body is far enough from the newest keyframe for another one; always if there is none. */
  bool wants(const Rigid& map_T_body) const;

  void clear();

  /**
   * Adds a keyframe and removes those that no longer belong to the map. `alignment`: covariance of the pose within the
   * map, tangent of boxPlus.
   */
  void add(const std::vector<View>& seen_from_body, const Rigid& map_T_body, const Matrix6d& alignment);

  /**
   * Covariance of a body's pose in the map that comes from the map: errors of its keyframes, and of the way's length.
   * Of the pose relative to the first keyframe, in the tangent of boxPlus at `map_T_body`.
   */
  Matrix6d drift(const Rigid& map_T_body) const;

  bool empty() const { return keyframes_.empty(); }

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
  Eigen::Vector3d begin_ = Eigen::Vector3d::Zero();  // where the first keyframe was
  std::deque<Keyframe> keyframes_;
  KeyframeErrors errors_;
  Matrix6d map_error_ = Matrix6d::Zero();  // covariance, as a step of a body at the map's origin
  NdtMap ndt_;
};
}  // namespace scanloom
