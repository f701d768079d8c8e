/** The machine's progress along its path: one drive, there and back, or a work cycle of short drives and stops. */
#pragma once
#include "base/core/Field.h"
#include "lab/simulation/internal/Taylor.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct DriveOptions
{
  double duration = 60.0;
  std::string route = "winding";
  double standstill = 2.5;
  double speed = 0.8;
  double speed_up = 2.0;
  double curve = 0.8;
  double curve_length = 22.0;
  double start = 0;
  double left = 0;
  int day = 0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.duration, Field{"duration", "s", "length of the recording", above(0)});
    visit(o.route, Field{"route", "",
                         "winding: rests, drives at 'speed', rests again; return: drives half of the time, turns round "
                         "on the spot and drives back; work: repeats the cycle of [simulated_work] until the recording "
                         "ends"});
    visit(o.standstill, Field{"standstill", "s",
                              "time at rest before and after a drive, and before and after turning round", atLeast(0)});
    visit(o.speed,
          Field{"speed", "m/s", "cruising speed along the axis of the path; route = work has speeds of its own",
                between(0, 40)});
    visit(o.speed_up, Field{"speed_up", "s", "time to reach the cruising speed, and to stop", above(0)});
    visit(o.curve, Field{"curve", "m", "amplitude of the winding path", between(0, 20)});
    visit(o.curve_length, Field{"curve_length", "m", "length of one period of the winding path", above(1)});
    visit(o.start,
          Field{"start", "m", "where on the path the drive starts: other drives through one stand", atLeast(0)});
    visit(o.left, Field{"left", "m", "how far left of the path the machine drives, within the lane that it keeps free",
                        between(-1.5, 1.5)});
    visit(o.day,
          Field{"day", "d", "how many days after the first drive: its stamps are those of another day", atLeast(0)});
  }
};

/** The work cycle of a harvester. Assumed: no published record was found. */
struct WorkCycleOptions
{
  double work_min = 30.0;
  double work_max = 120.0;
  double turn_after = 40.0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.work_min, Field{"work_min", "s", "shortest stop for work (assumed)", atLeast(0)});
    visit(o.work_max, Field{"work_max", "s", "longest stop for work (assumed)", atLeast(0)});
    visit(
        o.turn_after,
        Field{"turn_after", "m",
              "distance from the start after which the machine reverses to the start, rests and begins again; 0: never",
              atLeast(0)});
  }
};

/** A stop at which the machine works with its boom. */
struct WorkStop
{
  std::uint64_t number = 0;   // of the drive that leads there
  double begin = 0, end = 0;  // s
};

/** All drives and stops of a recording, drawn at construction. */
class Route
{
 public:
  /** Throws std::invalid_argument that names options which contradict each other. */
  Route(const DriveOptions&, const WorkCycleOptions&, std::uint64_t seed);

  /** m along the axis of the path, `t` s after the start of the recording. */
  Taylor progress(double t) const;

  /** Speed as a share of the cruising speed: 0 at rest, 1 while cruising. */
  Taylor driving(double t) const;

  /** rad, left of the path's direction: pi once the machine has turned round for the way back. */
  Taylor turned(double t) const;

  /** 1 while the machine works, 0 otherwise, with transitions of a second. */
  Taylor working(double t) const;

  /** The stop for work at that time, or after the drive of that number; nothing if there is none. */
  std::optional<WorkStop> workStopAt(double t) const;
  std::optional<WorkStop> workStop(std::uint64_t number) const;

  /** Number of the drive that began last; 0 before the first. */
  std::uint64_t legNumberAt(double t) const;
  std::uint64_t legs() const { return legs_.size(); }

  double duration() const { return duration_; }
  double farthest() const { return start_ + farthest_; }  // m, the largest progress

 private:
  struct Leg
  {
    double begin;   // s
    double moving;  // s, from the begin of speeding up to the begin of braking
    double from;    // m
    double speed;   // m/s, negative backwards
    bool works;     // at its end
  };
  void addWinding(const DriveOptions&);
  void addReturn(const DriveOptions&);
  void addWorkCycles(const DriveOptions&, const WorkCycleOptions&, std::uint64_t seed);
  const Leg* legAt(double t) const;  // the one that began last
  double endOf(const Leg& leg) const { return leg.begin + leg.moving + speed_up_; }

  double duration_, speed_up_, start_, farthest_ = 0;
  std::vector<Leg> legs_;
  std::optional<double> turns_at_;  // s: when it begins to turn round
};
}  // namespace scanloom
