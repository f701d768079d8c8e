#include "lab/study/internal/DriveQueue.h"

#include <gtest/gtest.h>

#include <future>

namespace scanloom::drive_queue_unittest
{
namespace
{
using namespace std::chrono_literals;

PlannedDrive simulatedDrive(std::vector<std::size_t> runs)
{
  PlannedDrive drive;
  drive.runs = std::move(runs);
  return drive;
}

PlannedDrive recordedDrive(std::size_t run)
{
  PlannedDrive drive;
  drive.recording = "recording";
  drive.runs = {run};
  return drive;
}

/** "d0" simulates, "d0 r3" runs, "" is the end. */
std::string nextOf(DriveQueue& queue)
{
  const auto work = queue.next();
  if (!work) return "";
  return "d" + std::to_string(work->drive) + (work->run ? " r" + std::to_string(*work->run) : "");
}

TEST(DriveQueue, simulatesADriveOnceAndThenRunsOnIt)
{
  DriveQueue queue({simulatedDrive({0, 2}), simulatedDrive({1})});

  EXPECT_EQ(nextOf(queue), "d0");
  queue.simulated(0);
  EXPECT_EQ(nextOf(queue), "d0 r0");
  EXPECT_EQ(nextOf(queue), "d0 r2");
  EXPECT_EQ(nextOf(queue), "d1");
  queue.simulated(1);
  EXPECT_EQ(nextOf(queue), "d1 r1");
  EXPECT_EQ(nextOf(queue), "");
}

TEST(DriveQueue, asksForNoSimulationOfRecordingsNorOfDrivesWithoutRuns)
{
  DriveQueue queue({simulatedDrive({}), recordedDrive(7)});

  EXPECT_EQ(nextOf(queue), "d1 r7");
  EXPECT_EQ(nextOf(queue), "");
}

TEST(DriveQueue, simulatesTheNextDriveWhileTheFirstIsBeingSimulated)
{
  DriveQueue queue({simulatedDrive({0}), simulatedDrive({1})});

  EXPECT_EQ(nextOf(queue), "d0");
  EXPECT_EQ(nextOf(queue), "d1");
}

TEST(DriveQueue, waitsForADriveThatAnotherJobSimulates)
{
  DriveQueue queue({simulatedDrive({0, 1})});
  ASSERT_EQ(nextOf(queue), "d0");

  auto other = std::async(std::launch::async, [&] { return nextOf(queue); });
  EXPECT_EQ(other.wait_for(50ms), std::future_status::timeout);
  queue.simulated(0);
  EXPECT_EQ(other.get(), "d0 r0");
}

TEST(DriveQueue, tellsWhenNoRunOfADriveIsLeftEvenInAnotherJob)
{
  DriveQueue queue({simulatedDrive({0, 1})});
  nextOf(queue);
  queue.simulated(0);
  nextOf(queue);
  nextOf(queue);

  EXPECT_FALSE(queue.finishedRun(0));
  EXPECT_TRUE(queue.finishedRun(0));
}
}  // namespace
}  // namespace scanloom::drive_queue_unittest
