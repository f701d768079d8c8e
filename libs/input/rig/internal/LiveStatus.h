/** Shows what live lidars deliver: a line per second on a terminal, otherwise a line per 10 s. */
#pragma once
#include "base/core/Progress.h"
#include "input/rig/RepeatedWarnings.h"
#include "input/rig/SensorInput.h"

namespace scanloom
{
/** The work of a verb on the scans so far, in s. */
struct Work
{
  double recorded = 0;  // time of the sensors that was processed
  double busy = 0;      // wall-clock time that this took, without waiting for input
};

class LiveStatus
{
 public:
  using Clock = std::chrono::steady_clock;

  explicit LiveStatus(std::string what, std::ostream& out = std::cerr, bool terminal = standardErrorIsTerminal());
  LiveStatus(const LiveStatus&) = delete;
  LiveStatus& operator=(const LiveStatus&) = delete;
  ~LiveStatus();

  /** Prints a line if one is due, and the input's warnings at once. */
  void update(SensorInput&, const Work& = {}, Clock::time_point now = Clock::now());

  /** At once; those that come again are counted. */
  void warn(const std::string&, Clock::time_point now = Clock::now());

  /**
   * `left 640/s, right 640/s packets; columns: 0 lost, 0 late, 0 dropped; datagrams: 0 dropped; scans: 0 waiting, 0
   * dropped`
   */
  static std::string line(const RigAccount& before, const RigAccount& now, double seconds);

  /** The same in `width` characters at most, with what is missing only if there is any: `left 640/s, right 640/s; 16
   * lost`
   */
  static std::string shortLine(const RigAccount& before, const RigAccount& now, double seconds, std::size_t width);

  /** `; 3.1 times real time`; empty if nothing was processed in between. */
  static std::string pace(const Work& before, const Work& now);

 private:
  void say(const std::string& warning);
  std::string lineOf(const RigAccount&, const Work&, Clock::time_point now) const;

  std::string what_;
  std::ostream& out_;
  bool terminal_;
  bool line_open_ = false;  // the cursor is at the end of a line that the next one replaces
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_at_ = start_;
  RigAccount shown_;
  RepeatedWarnings warnings_;
  Work shown_work_;
};
}  // namespace scanloom
