// Two drives through one stand: the second one is localised in the map of the first.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/formats/Trajectory.h"
#include "mrpt/maps/SimpleMapReader.h"
#include "support/TemporaryFolder.h"
#include "support/runProgram.h"

#include <fmt/format.h>

namespace scanloom::in_a_map_unittest
{
namespace
{
using testing::HasSubstr;

struct InAMap : testing::Test
{
  TemporaryFolder folder;

  std::string in(const std::string& name) const { return (folder / name).string(); }

  void simulate(const std::string& name, const std::string& settings) const
  {
    const std::string command = SCANLOOM_BIN_DIR "/scanloom simulate -c " SCANLOOM_SOURCE_DIR
                                                 "/params/simulation/sparse.ini --set simulated_stand.seed=7 "
                                                 "--set simulated_lidars.lidar1_mode=512x10 --set "
                                                 "simulated_drive.route=winding --set simulated_drive.standstill=3 " +
                                settings + " --out-dir " + in(name) + " 2>&1";
    const Ended ended = runProgram(command);
    ASSERT_EQ(ended.status, 0) << ended.output;
  }

  Ended slam(const std::string& recording, const std::string& settings) const
  {
    return runProgram(SCANLOOM_BIN_DIR "/scanloom slam " + in(recording) + " " + settings +
                      " --every-nth 2 --out-dir " + in(recording + "_slam") + " 2>&1 </dev/null");
  }

  Trajectory truthOf(const std::string& recording) const { return readTum(folder / recording / "groundtruth.tum"); }
  Trajectory posesOf(const std::string& recording) const
  {
    return readTum(folder / (recording + "_slam") / "trajectory.tum");
  }
};
}  // namespace

TEST_F(InAMap, aSecondDriveHasItsPosesInTheFrameOfTheFirst)
{
  simulate("first", "--seed 1 --set simulated_drive.duration=20 --set simulated_drive.speed=1.2");
  simulate("second",
           "--seed 2 --set simulated_drive.duration=18 --set simulated_drive.speed=1.2 "
           "--set simulated_drive.start=3 --set simulated_drive.left=0.5");
  Ended ended = slam("first", "");
  ASSERT_EQ(ended.status, 0) << ended.output;
  ended = slam("second", "--map " + in("first_slam"));
  ASSERT_EQ(ended.status, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("found in the map after "));

  const Trajectory map = posesOf("first"), poses = posesOf("second"), truth = truthOf("second");
  const Rigid world_T_map = poseAt(truthOf("first"), map.front().stamp).value() * map.front().map_T_body.inverse();
  ASSERT_GT(poses.size(), 30U);
  for (const StampedPose& pose : poses)
    EXPECT_LT(boxMinus(world_T_map * pose.map_T_body, poseAt(truth, pose.stamp).value()).head<3>().norm(), 0.15);
}

TEST_F(InAMap, aMapGrowsByTheKeyframesOfADriveThatGoesFarther)
{
  simulate("first", "--seed 1 --set simulated_drive.duration=16 --set simulated_drive.speed=1.2");
  simulate("second", "--seed 2 --set simulated_drive.duration=24 --set simulated_drive.speed=1.2");
  ASSERT_EQ(slam("first", "").status, 0);
  const Ended ended = slam("second", "--grow --map " + in("first_slam"));
  ASSERT_EQ(ended.status, 0) << ended.output;
  const auto keyframesOf = [&](const char* run)
  {
    const SimpleMapReader reader(folder / run / "keyframes.simplemap");
    std::vector<Keyframe> keyframes;
    for (std::size_t i = 0; i < reader.size(); ++i) keyframes.push_back(reader.keyframe(i));
    return keyframes;
  };
  const std::vector<Keyframe> before = keyframesOf("first_slam"), grown = keyframesOf("second_slam");
  ASSERT_GT(grown.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    const Keyframe& kept = grown[grown.size() - before.size() + i];
    EXPECT_LT(boxMinus(kept.map_T_body, before[i].map_T_body).norm(), 1e-9);
    EXPECT_EQ(kept.points.sensor_id, before[i].points.sensor_id);
  }
}

TEST_F(InAMap, aFolderWithoutAMapSaysWhatToDo)
{
  simulate("drive", "--seed 1 --set simulated_drive.duration=12");
  const Ended ended = slam("drive", "--map " + in("drive"));
  EXPECT_EQ(ended.status, 2) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("result folder of `scanloom slam`"));
}
}  // namespace scanloom::in_a_map_unittest
