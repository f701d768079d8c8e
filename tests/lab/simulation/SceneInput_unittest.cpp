#include "support/SceneInput.h"

#include "input/rig/internal/RigReplay.h"
#include "lab/simulation/RecordingFolder.h"
#include "support/TemporaryFolder.h"
#include "support/recordedRig.h"

#include <gtest/gtest.h>

namespace scanloom::scene_input_unittest
{
namespace
{
SimulationSettings shortDrive()
{
  SimulationSettings settings;
  settings.drive.duration = 4;
  settings.drive.standstill = 0.5;
  settings.drive.speed_up = 1;
  settings.lidars[0].model = "OS0-16";
  settings.lidars[0].faults.loss = 0.02;
  return settings;
}

bool same(const SensorImu& a, const SensorImu& b)
{
  return a.sensor == b.sensor && a.sample.stamp == b.sample.stamp && a.sample.gyro == b.sample.gyro &&
         a.sample.accel == b.sample.accel;
}

bool same(const Scan& a, const Scan& b)
{
  return a.start == b.start && a.points.x == b.points.x && a.points.y == b.points.y && a.points.z == b.points.z &&
         a.points.t == b.points.t && a.columns.size() == b.columns.size() && a.missing == b.missing;
}

TEST(SceneInput, givesTheEventsOfTheWrittenRecordingToTheBit)
{
  const TemporaryFolder folder;
  const auto scene = std::make_shared<const Scene>(makeScene(shortDrive(), 5));
  writeRecording(*scene, folder.path(), [](double) {});
  const RigSettings settings = recordedRigSettings(folder.path());
  RigReplay written(makeRig(settings));
  const auto direct = makeSceneInput(scene, rigOf(*scene, settings.batcher));

  int scans = 0, imu = 0;
  while (auto expected = written.next())
  {
    const auto event = direct->next();
    ASSERT_TRUE(event);
    ASSERT_EQ(event->index(), expected->index());
    if (const auto* scan = std::get_if<Scan>(&*expected))
    {
      ASSERT_TRUE(same(*scan, std::get<Scan>(*event))) << scans;
      ++scans;
    }
    if (const auto* sample = std::get_if<SensorImu>(&*expected))
    {
      ASSERT_TRUE(same(*sample, std::get<SensorImu>(*event))) << imu;
      ++imu;
    }
  }
  EXPECT_FALSE(direct->next());
  EXPECT_GE(scans, 38);
  EXPECT_GE(imu, 4 * 390);
  EXPECT_EQ(direct->account().lidars[0].counters.lost, written.account().lidars[0].counters.lost);
  EXPECT_GT(written.account().lidars[0].counters.lost, 0u);
}

TEST(SceneInput, leavesOutLidarsThatAreNotWanted)
{
  const Scene scene = makeScene(shortDrive(), 5);
  const Rig rig = rigOf(scene, {}, {"right"});
  ASSERT_EQ(rig.lidars.size(), 1u);
  EXPECT_EQ(rig.lidars[0].name, "right");
  EXPECT_THROW(rigOf(scene, {}, {"middle"}), std::invalid_argument);
}
}  // namespace
}  // namespace scanloom::scene_input_unittest
