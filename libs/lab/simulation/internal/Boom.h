/** The machine's crane: a pillar that slews, two links, and the felling head at their end. Its sizes are those of a
 * mid-size harvester, in round figures (assumed). */
#pragma once
#include "lab/simulation/internal/Route.h"
#include "lab/simulation/internal/Solids.h"

#include <vector>

namespace scanloom
{
struct BoomPose
{
  double slew = 0;    // rad, to the left
  double reach = 0;   // m from the pillar to the head's joint
  double height = 0;  // m of that joint above the pillar's
};

/** The joints in the vertical plane of the boom, from its pillar's joint: (outwards, upwards), m. */
struct BoomJoints
{
  Eigen::Vector2d elbow, tip;
};

class Boom
{
 public:
  Boom(const Route&, std::uint64_t seed);

  /** The pose `t` s after the start of the recording: it moves at the stops for work only. */
  BoomPose at(double t) const;

  /** The law of cosines gives the elbow; of both solutions the upper one. */
  BoomJoints jointsAt(const BoomPose&) const;

  /** Boxes of pillar, links and head in the body frame. */
  std::vector<OrientedBox> boxes(const BoomPose&) const;

 private:
  BoomPose target(const WorkStop&, std::uint64_t move, std::uint64_t moves) const;

  Route route_;
  std::uint64_t seed_;
};
}  // namespace scanloom
