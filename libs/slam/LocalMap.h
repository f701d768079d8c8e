/** The last keyframes (paper, section 2.2), or those nearby, as one NDT map in the map frame. */
#pragma once
#include "core/Field.h"
#include "core/Rigid.h"
#include "ndt/NdtMap.h"

#include <deque>
#include <optional>

namespace scanloom
{
struct LocalMapOptions
{
  double keyframe_distance = 4.0;
  double keyframe_turn_deg = 20.0;
  int keyframes = 3;
  double radius = 0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.keyframe_distance, Field{"keyframe_distance", "m", "travel before a new keyframe", above(0)});
    visit(o.keyframe_turn_deg,
          Field{"keyframe_turn_deg", "deg", "turn before a new keyframe; 180: never", between(1, 180)});
    visit(o.keyframes, Field{"keyframes", "", "how many are kept", atLeast(1)});
    visit(o.radius, Field{"radius", "m",
                          "all keyframes so near to the newest are the map, also those of earlier passes, in place of "
                          "the last ones; 0: the last ones",
                          atLeast(0)});
  }
};

class LocalMap
{
 public:
  LocalMap(const LocalMapOptions&, const NdtOptions&);

  /** Whether a body there is far enough from the newest keyframe; true while there is none. */
  bool wants(const Rigid& map_T_body) const;

  /** Forgets all keyframes. */
  void clear();

  /** Adds a keyframe, its views in the body frame, and forgets the oldest past the limit. */
  void add(const std::vector<View>& seen_from_body, const Rigid& map_T_body);

  bool empty() const { return keyframes_.empty(); }
  const NdtMap& ndt() const { return ndt_; }

 private:
  struct Keyframe
  {
    Rigid map_T_body;
    NdtMap ndt;  // of this keyframe alone, in the map frame
    bool in_map = false;
  };

  bool belongs(const Keyframe&, std::size_t age) const;

  LocalMapOptions options_;
  std::deque<Keyframe> keyframes_;
  NdtMap ndt_;
};
}  // namespace scanloom
