#include "lab/study/internal/DriveQueue.h"

#include <algorithm>

namespace scanloom
{
DriveQueue::DriveQueue(std::vector<PlannedDrive> drives)
{
  for (PlannedDrive& drive : drives)
    drives_.push_back({std::move(drive.runs), drive.simulated() ? State::Planned : State::Ready});
}

std::optional<DriveQueue::Work> DriveQueue::next()
{
  std::unique_lock lock(mutex_);
  std::optional<Work> work;
  changed_.wait(lock,
                [&]
                {
                  work = availableWork();
                  return work || !someDriveIsBeingSimulated();
                });
  return work;
}

std::optional<DriveQueue::Work> DriveQueue::availableWork()
{
  for (std::size_t i = 0; i < drives_.size(); ++i)
    if (Drive& drive = drives_[i]; drive.state == State::Ready && drive.handed_out < drive.runs.size())
      return Work{i, drive.runs[drive.handed_out++]};
  for (std::size_t i = 0; i < drives_.size(); ++i)
    if (Drive& drive = drives_[i]; drive.state == State::Planned && !drive.runs.empty())
    {
      drive.state = State::BeingSimulated;
      return Work{i, std::nullopt};
    }
  return std::nullopt;
}

bool DriveQueue::someDriveIsBeingSimulated() const
{
  return std::any_of(drives_.begin(), drives_.end(),
                     [](const Drive& drive) { return drive.state == State::BeingSimulated; });
}

void DriveQueue::simulated(std::size_t drive)
{
  const std::lock_guard lock(mutex_);
  drives_[drive].state = State::Ready;
  changed_.notify_all();
}

bool DriveQueue::finishedRun(std::size_t drive)
{
  const std::lock_guard lock(mutex_);
  return ++drives_[drive].finished == drives_[drive].runs.size();
}
}  // namespace scanloom
