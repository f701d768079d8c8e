/** What the page says in words and numbers. */
#pragma once
#include "base/core/Time.h"

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct ViewedLidar
{
  std::string name, model;
  double rate = 0;                     // packets/s, or, of a rawlog, columns/s
  std::uint64_t lost = 0;              // columns that never arrived
  std::uint64_t left_out = 0;          // columns that came too late, or for which there was no room
  std::optional<double> clock_offset;  // s, what is added to its stamps; none: a rawlog does not tell
  std::optional<Timestamp> seen;       // end of the last scan with columns of it
  double returns = 0;                  // share of the beams that came back, in the last second
  double usual_returns = 0;            // the same since the start
};

struct ViewedImu
{
  std::string name;
  double rate = 0;  // samples/s of the sensor's time
  Timestamp seen;
};

struct CountedWarning
{
  std::string text;
  std::uint64_t count = 1;
  std::chrono::steady_clock::time_point last;
};

struct ShownMark
{
  std::string text;
  double after = 0;  // s after the first scan
};

/** A player of a recording. */
struct PlayerStatus
{
  bool playing = true;
  double speed = 1;     // times real time
  double position = 0;  // s after the start of the recording
  double length = 0;    // s; 0: not known yet
};

struct ViewStatus
{
  std::string verb;
  bool live = false;   // lidars, not a recording
  bool ended = false;  // no more will come
  std::string health;  // OK, DEGENERATE, LOST, INITIALISING; empty: nothing is localised
  std::string why;     // of DEGENERATE: what is open
  std::uint64_t scans = 0, poses = 0, keyframes = 0, keyframes_left_out = 0, marks = 0;
  std::optional<Timestamp> first, newest;             // ends of scans
  std::chrono::steady_clock::time_point scan_came{};  // the newest
  double distance = 0, speed = 0;                     // m, m/s
  std::optional<double> factor;                       // times real time
  std::vector<ViewedLidar> lidars;
  std::vector<ViewedImu> imus;
  std::deque<CountedWarning> warnings;  // newest first
  std::deque<ShownMark> newest_marks;   // newest first, of all `marks`
  std::optional<PlayerStatus> player;
};

/** s since the lidar's last columns, by the lidars' time and, live, by this computer's while no scan comes at all. */
double silenceOf(const ViewedLidar&, const ViewStatus&, std::chrono::steady_clock::time_point now);

/** A lidar that is silent for this long, in s, is named. */
constexpr double kSilent = 0.8;

/**
 * The health in one word: LOST, SILENT (a lidar), DEGENERATE, INITIALISING, OK, WAITING (for a scan), RUNNING, PLAYING,
 * PAUSED, ENDED.
 */
std::string wordFor(const ViewStatus&, std::chrono::steady_clock::time_point now);
}  // namespace scanloom
