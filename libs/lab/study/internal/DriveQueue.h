/** Gives each thread of a sweep its next work: simulate a drive, or run slam on one. */
#pragma once
#include "lab/study/PlannedDrive.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <vector>

namespace scanloom
{
/** Runs on drives that have packets come first, so that the packets of few drives are kept. Threads share it. */
class DriveQueue
{
 public:
  struct Work
  {
    std::size_t drive = 0;           // its place among the drives of the constructor
    std::optional<std::size_t> run;  // its place in the plan; none: simulate the drive
  };

  /** @param drives with the runs to do; a drive without runs is not simulated. */
  explicit DriveQueue(std::vector<PlannedDrive> drives);

  /** Waits if the only runs left are on drives that other threads simulate now. None: no work is left. */
  std::optional<Work> next();

  /** To be called when the simulation has ended, also when it failed: then its runs report that. */
  void simulated(std::size_t drive);

  /** To be called after each run. @return true if it was the last of the drive, also counting the other threads. */
  bool finishedRun(std::size_t drive);

 private:
  enum class State
  {
    Planned,
    BeingSimulated,
    Ready
  };
  struct Drive
  {
    std::vector<std::size_t> runs;
    State state;
    std::size_t handed_out = 0, finished = 0;  // numbers of runs
  };
  std::optional<Work> availableWork();
  bool someDriveIsBeingSimulated() const;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Drive> drives_;
};
}  // namespace scanloom
