/** The machine's crane: a pillar that slews, two links, and the felling head at their end. */
#pragma once
#include "base/core/Field.h"
#include "lab/simulation/internal/Route.h"
#include "lab/simulation/internal/Solids.h"

#include <vector>

namespace scanloom
{
/** Where the felling head is while the machine drives and while it works. */
struct BoomReachOptions
{
  double reach_rest = 4.5;
  double reach_min = 4.0;
  double reach_max = 7.5;
  double height_rest = 0.3;
  double height_min = -1.2;
  double height_max = 0.8;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.reach_rest, Field{"reach_rest", "m",
                              "distance of the head from the pillar while the machine drives (assumed)", above(0)});
    visit(o.reach_min,
          Field{"reach_min", "m", "smallest distance of the head from the pillar at work (assumed)", above(0)});
    visit(o.reach_max,
          Field{"reach_max", "m", "largest distance of the head from the pillar at work (assumed)", above(0)});
    visit(o.height_rest,
          Field{"height_rest", "m", "height of the head's joint above the pillar's while the machine drives (assumed)",
                between(-10, 10)});
    visit(o.height_min,
          Field{"height_min", "m", "lowest height of the head's joint above the pillar's at work (assumed)",
                between(-10, 10)});
    visit(o.height_max,
          Field{"height_max", "m", "greatest height of the head's joint above the pillar's at work (assumed)",
                between(-10, 10)});
  }
};

/** Sizes of the boom's parts. */
struct BoomShapeOptions
{
  double link_width = 0.32;
  double pillar_width = 0.6;
  double pillar_height = 1.0;
  double head_length = 0.7;
  double head_width = 0.8;
  double head_height = 1.4;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.link_width, Field{"link_width", "m", "width of both links (assumed)", between(0.01, 2)});
    visit(o.pillar_width, Field{"pillar_width", "m", "width of the pillar (assumed)", between(0.01, 3)});
    visit(o.pillar_height,
          Field{"pillar_height", "m", "height of the pillar, below its joint (assumed)", between(0.01, 3)});
    visit(o.head_length,
          Field{"head_length", "m", "length of the felling head, away from the machine (assumed)", between(0.01, 3)});
    visit(o.head_width, Field{"head_width", "m", "width of the felling head (assumed)", between(0.01, 3)});
    visit(o.head_height,
          Field{"head_height", "m", "height of the felling head, which hangs from the outer link (assumed)",
                between(0.01, 3)});
  }
};

/** How the boom moves while it works. */
struct BoomMotionOptions
{
  double swing_deg = 60;
  double slew_min = 20;
  double slew_max = 40;
  double move_every = 8;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.swing_deg,
          Field{"swing_deg", "deg", "largest slew angle to either side at work (assumed)", between(0, 90)});
    visit(o.slew_min,
          Field{"slew_min", "deg/s", "the largest slew rate within a move is at least this (assumed)", above(0)});
    visit(o.slew_max,
          Field{"slew_max", "deg/s", "the largest slew rate within a move is at most this (assumed)", above(0)});
    visit(o.move_every,
          Field{"move_every", "s", "time from the start of one move to the start of the next (assumed)", above(0.5)});
  }
};

/** All assumed: round figures of a mid-size harvester. */
struct BoomOptions
{
  bool boom = true;
  double base_x = 2.2;
  double base_height = 2.0;
  double inner_link = 4.0;
  double outer_link = 4.5;
  BoomReachOptions reach;
  BoomShapeOptions shape;
  BoomMotionOptions motion;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.boom, Field{"boom", "", "whether the machine has a boom"});
    visit(o.base_x, Field{"base_x", "m", "x of the pillar in the body frame (assumed)", between(-10, 10)});
    visit(o.base_height,
          Field{"base_height", "m", "height of the joint between pillar and inner link, in the body frame (assumed)",
                between(0, 5)});
    visit(o.inner_link,
          Field{"inner_link", "m", "length of the inner link, from the pillar to the elbow (assumed)", above(0.1)});
    visit(o.outer_link,
          Field{"outer_link", "m", "length of the outer link, from the elbow to the head (assumed)", above(0.1)});
    BoomReachOptions::fields(o.reach, visit);
    BoomShapeOptions::fields(o.shape, visit);
    BoomMotionOptions::fields(o.motion, visit);
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
  /** Throws std::invalid_argument if the links are too short or too long for the reach. */
  Boom(const BoomOptions&, const Route&, std::uint64_t seed);

  /** The pose `t` s after the start of the recording: it moves at the stops for work only. */
  BoomPose at(double t) const;

  /** The law of cosines gives the elbow; of both solutions the upper one. */
  BoomJoints jointsAt(const BoomPose&) const;

  /** Boxes of pillar, links and head in the body frame; none without a boom. */
  std::vector<OrientedBox> boxes(const BoomPose&) const;

 private:
  BoomPose target(const WorkStop&, std::uint64_t move, std::uint64_t moves) const;

  BoomOptions options_;
  Route route_;
  std::uint64_t seed_;
};
}  // namespace scanloom
