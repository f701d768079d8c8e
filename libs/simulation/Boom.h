/** The machine's crane: a pillar that slews, two links, and the felling head at their end. */
#pragma once
#include "core/Field.h"
#include "simulation/Route.h"
#include "simulation/Solids.h"

#include <vector>

namespace scanloom
{
/** All assumed: round figures of a mid-size harvester. */
struct BoomOptions
{
  bool boom = true;
  double base_x = 2.2;
  double base_height = 2.0;
  double inner_link = 4.0;
  double outer_link = 4.5;
  double reach_rest = 4.5;
  double reach_min = 4.0;
  double reach_max = 7.5;
  double height_rest = 0.3;
  double height_min = -1.2;
  double height_max = 0.8;
  double link_width = 0.32;
  double pillar_width = 0.6;
  double pillar_height = 1.0;
  double head_length = 0.7;
  double head_width = 0.8;
  double head_height = 1.4;
  double swing_deg = 60;
  double slew_min = 20;
  double slew_max = 40;
  double move_every = 8;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.boom, Field{"boom", "", "false: the machine has none"});
    visit(o.base_x, Field{"base_x", "m", "of its pillar on the body (assumed)", between(-10, 10)});
    visit(o.base_height, Field{"base_height", "m", "of the lower link's joint on the pillar (assumed)", between(0, 5)});
    visit(o.inner_link, Field{"inner_link", "m", "from the pillar to the elbow (assumed)", above(0.1)});
    visit(o.outer_link, Field{"outer_link", "m", "from the elbow to the head (assumed)", above(0.1)});
    visit(o.reach_rest,
          Field{"reach_rest", "m", "from the pillar to the head while the machine drives (assumed)", above(0)});
    visit(o.reach_min, Field{"reach_min", "m", "nearest that it works (assumed)", above(0)});
    visit(o.reach_max, Field{"reach_max", "m", "farthest that it works (assumed)", above(0)});
    visit(o.height_rest,
          Field{"height_rest", "m", "of the head's joint above the lower link's while it drives (assumed)",
                between(-10, 10)});
    visit(o.height_min, Field{"height_min", "m", "lowest that it works, likewise (assumed)", between(-10, 10)});
    visit(o.height_max, Field{"height_max", "m", "highest that it works, likewise (assumed)", between(-10, 10)});
    visit(o.link_width, Field{"link_width", "m", "of both links (assumed)", between(0.01, 2)});
    visit(o.pillar_width, Field{"pillar_width", "m", "of the pillar (assumed)", between(0.01, 3)});
    visit(o.pillar_height, Field{"pillar_height", "m", "below the lower link's joint (assumed)", between(0.01, 3)});
    visit(o.head_length,
          Field{"head_length", "m", "of the felling head, away from the machine (assumed)", between(0.01, 3)});
    visit(o.head_width, Field{"head_width", "m", "of the head (assumed)", between(0.01, 3)});
    visit(o.head_height,
          Field{"head_height", "m", "of the head, which hangs from the upper link (assumed)", between(0.01, 3)});
    visit(o.swing_deg, Field{"swing_deg", "deg", "to both sides while it works (assumed)", between(0, 90)});
    visit(o.slew_min, Field{"slew_min", "deg/s", "slowest of the largest rates of its moves (assumed)", above(0)});
    visit(o.slew_max, Field{"slew_max", "deg/s", "fastest of them (assumed)", above(0)});
    visit(o.move_every,
          Field{"move_every", "s", "from the begin of a move to the next; it rests in between (assumed)", above(0.5)});
  }
};

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
  /** Throws std::invalid_argument if the links cannot reach so far or so near. */
  Boom(const BoomOptions&, const Route&, std::uint64_t seed);

  /** Moves at the stops for work, one target after the other, and rests elsewhere. */
  BoomPose at(double t) const;

  /** By the law of cosines, elbow upwards. */
  BoomJoints jointsAt(const BoomPose&) const;

  /** Pillar, links and head in the body frame; none if there is no boom. */
  std::vector<OrientedBox> boxes(const BoomPose&) const;

 private:
  BoomPose target(const WorkStop&, std::uint64_t move, std::uint64_t moves) const;

  BoomOptions options_;
  Route route_;
  std::uint64_t seed_;
};
}  // namespace scanloom
