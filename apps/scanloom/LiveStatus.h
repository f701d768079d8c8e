/** What the lidars deliver at the moment, for the person who records: a line a second on a terminal, a line per 10 s
 * anywhere else. */
#pragma once
#include "Progress.h"
#include "source/RigInput.h"

namespace scanloom
{
/** Of a verb that works on the scans, so far, in s. */
struct Work
{
  double recorded = 0;  // of what the sensors measured
  double busy = 0;      // that it took, without waiting for more of it
};

class LiveStatus
{
 public:
  using Clock = std::chrono::steady_clock;

  explicit LiveStatus(std::string what, std::ostream& out = std::cerr, bool terminal = standardErrorIsTerminal());
  LiveStatus(const LiveStatus&) = delete;
  LiveStatus& operator=(const LiveStatus&) = delete;
  ~LiveStatus();

  /** Asks the input for its account only when a line is due. Warnings are shown at once. */
  void update(RigInput&, const Work& = {}, Clock::time_point now = Clock::now());

  /** `left 640/s, right 640/s packets; lost 0, late 0, dropped 0 columns; 0 scans wait, 0 dropped` */
  static std::string line(const RigAccount& before, const RigAccount& now, double seconds);

  /** `; 3.1 times real time`; nothing if nothing was worked on in between. */
  static std::string pace(const Work& before, const Work& now);

 private:
  std::string what_;
  std::ostream& out_;
  bool terminal_;
  bool line_open_ = false;  // the cursor stands behind a line that the next one replaces
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_at_ = start_;
  RigAccount shown_;
  Work shown_work_;
};
}  // namespace scanloom
