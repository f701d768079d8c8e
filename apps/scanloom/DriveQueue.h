/** Who does what next in a sweep whose runs wait for their drives' packets. */
#pragma once
#include "study/PlannedDrive.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <vector>

namespace scanloom
{
/** Runs of drives that are there go first, so that few drives are kept at once. Threads share it. */
class DriveQueue
{
 public:
  struct Work
  {
    std::size_t drive = 0;           // its place among those given
    std::optional<std::size_t> run;  // its place in the plan; nothing: the drive is to be simulated
  };

  /** @param drives with the runs that are to be done; those without any are not simulated. */
  explicit DriveQueue(std::vector<PlannedDrive> drives);

  /** Waits while all that is left are runs of drives that others simulate. Nothing: no work is left. */
  std::optional<Work> next();

  /** Also after a failure: its runs tell of it. */
  void simulated(std::size_t drive);

  /** @return no run of the drive is left, not even one that others are at. */
  bool finishedRun(std::size_t drive);

 private:
  enum class State
  {
    Planned,
    BeingSimulated,
    There
  };
  struct Drive
  {
    std::vector<std::size_t> runs;
    State state;
    std::size_t given = 0, finished = 0;  // of the runs
  };
  std::optional<Work> workAtHand();
  bool someoneSimulates() const;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Drive> drives_;
};
}  // namespace scanloom
