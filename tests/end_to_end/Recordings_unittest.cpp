// The whole line on a stranger's recordings: captures of two lidars and an IMU in, a trajectory out.
#include <gtest/gtest.h>

#include "input/rig/internal/RigReplay.h"
#include "input/rig/openRig.h"
#include "lab/evaluation/PositionError.h"
#include "mrpt/observations/RawlogInput.h"
#include "mrpt/observations/RawlogWriter.h"
#include "mrpt/observations/RigObservations.h"
#include "run/run/SlamFiles.h"
#include "run/run/SlamRun.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/harvesterSettings.h"
#include "support/recordedRig.h"

namespace scanloom::recordings_unittest
{
namespace
{
RunSummary localise(SensorInput& input, const std::filesystem::path& folder,
                    const SlamSettings& settings = harvesterSettings())
{
  SlamFiles files(folder, input.setup().header.lidars, {});
  SlamRunResult result = runSlam(
      input, settings, [&](const StateEstimate& estimate) { files.add(estimate); },
      [](const RunProgress&) { return true; }, [](const std::string& warning) { ADD_FAILURE() << warning; });
  EXPECT_TRUE(result.passed);
  files.close(result.summary);
  return result.summary;
}

double largestError(const std::filesystem::path& run, const std::filesystem::path& recording)
{
  return positionErrorFromFirstPose(readTum(run / "trajectory.tum"), readTum(recording / "groundtruth.tum")).largest;
}

void expectDrift(const std::filesystem::path& recording, const std::vector<std::string>& lidars, int every_nth,
                 double limit)
{
  const TemporaryFolder folder;
  SlamSettings settings = harvesterSettings();
  settings.slam.every_nth = every_nth;
  const auto input = openRig(makeRig(recordedRigSettings(recording), lidars));
  localise(*input, folder.path(), settings);
  const double error = largestError(folder.path(), recording);
  testing::Test::RecordProperty("largest_error_m", std::to_string(error));
  EXPECT_LT(error, limit);
}
}  // namespace

TEST(Recordings, twoLidarsStayWithinFifteenCentimetresInTheSparseStand)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  expectDrift(recording, {}, 1, 0.15);
}

TEST(Recordings, twoLidarsStayWithinThirtyCentimetresInTheDenseStand)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/dense");
  expectDrift(recording, {}, 1, 0.30);
}

TEST(Recordings, everyFifteenthScanIsEnoughForTwoLidarsInTheDenseStand)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/dense");
  expectDrift(recording, {}, 15, 0.30);
}

TEST(Recordings, aSingleLidarIsNotLostInTheDenseStand)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/dense");
  expectDrift(recording, {"left"}, 1, 0.5);
}

TEST(Recordings, everyScanGetsAPoseAtItsEndAndASecondRunGivesTheSameBytes)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder first, second;
  const RunSummary summary = localise(*openRig(makeRig(recordedRigSettings(recording))), first.path());
  localise(*openRig(makeRig(recordedRigSettings(recording))), second.path());

  const Trajectory trajectory = readTum(first / "trajectory.tum");
  EXPECT_EQ(trajectory.size(), summary.counts.at("scans"));
  for (std::size_t i = 1; i < trajectory.size(); ++i) EXPECT_EQ(trajectory[i].stamp - trajectory[i - 1].stamp, 100ms);
  for (const char* name : {"trajectory.tum", "trajectory_imu.tum", "trajectory.csv", "map.ply", "keyframes.simplemap"})
    EXPECT_EQ(contentOf(first / name), contentOf(second / name)) << name;
}

TEST(Recordings, aRawlogGivesThePosesOfItsCaptureWithinAMillimetre)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder folder;
  const Rig rig = makeRig(recordedRigSettings(recording));
  RawlogWriter writer(folder / "dual.rawlog", recordingHeader(rig), {});
  RigReplay replay(rig);
  while (const auto event = replay.next()) writer.write(*toObservation(*event, replay.setup(), DriverOptions{}));
  writer.close();

  localise(*openRig(rig), folder / "capture");
  RawlogInput rawlog(folder / "dual.rawlog");
  localise(rawlog, folder / "rawlog");

  const Trajectory expected = readTum(folder / "capture/trajectory.tum"),
                   got = readTum(folder / "rawlog/trajectory.tum");
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i)
    EXPECT_LT((got[i].map_T_body.translation - expected[i].map_T_body.translation).norm(), 1e-3);
}
}  // namespace scanloom::recordings_unittest
