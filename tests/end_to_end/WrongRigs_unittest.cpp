// A stranger's recordings with a left lidar that is not where, or not what, the configuration says: slam names it, says
// by how much, does not blame the IMU, and does not end with success.
#include "input/rig/internal/RigReplay.h"
#include "input/rig/openRig.h"
#include "run/run/SlamFiles.h"
#include "run/run/SlamRun.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/harvesterSettings.h"
#include "support/recordedRig.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace scanloom::wrong_rigs_unittest
{
using testing::HasSubstr;

namespace
{
struct WrongRig
{
  const char* name;
  const char* pose;   // of the left lidar, as in extrinsics.txt; it is 1.5 1.2 2.5 30 15 -25
  const char* beams;  // what is done to its beam angles: "", "reversed", "of another"
  const char* said;   // in the first warning; "": none
};
void PrintTo(const WrongRig& rig, std::ostream* out) { *out << rig.name; }

/** Its metadata with other beam angles. */
std::string metadataOf(const std::filesystem::path& recording, const std::string& beams)
{
  nlohmann::json metadata = nlohmann::json::parse(contentOf(recording / "left.json"));
  nlohmann::json& table = metadata.contains("beam_intrinsics") ? metadata["beam_intrinsics"] : metadata;
  auto altitudes = table.at("beam_altitude_angles").get<std::vector<double>>();
  if (beams == "reversed") std::reverse(altitudes.begin(), altitudes.end());
  if (beams == "of another")
    for (double& altitude : altitudes) altitude /= 2;  // an OS1's field of view
  table["beam_altitude_angles"] = altitudes;
  return metadata.dump();
}

Rig rigOf(const std::filesystem::path& recording, const WrongRig& wrong, const TemporaryFolder& folder)
{
  RigSettings settings = recordedRigSettings(recording, std::string("lidar1_pose = [") + wrong.pose + "]\n");
  settings.lidars[0].metadata = (folder / "left.json").string();
  std::ofstream(settings.lidars[0].metadata) << metadataOf(recording, wrong.beams);
  return makeRig(settings);
}

struct Told
{
  std::vector<std::string> warnings;
  bool passed;
};

Told localise(SensorInput& input, const std::filesystem::path& folder)
{
  Told told;
  SlamFiles files(folder, input.setup().header.lidars, OutputOptions{false, "", 0});
  const SlamRunResult result = runSlam(
      input, harvesterSettings(), [&](const StateEstimate& estimate) { files.add(estimate); },
      [](const RunProgress&) { return true; }, [&](const std::string& warning) { told.warnings.push_back(warning); });
  files.close(result.summary);
  told.passed = result.passed;
  return told;
}
}  // namespace

using WrongRigs = testing::TestWithParam<std::tuple<const char*, WrongRig>>;

TEST_P(WrongRigs, areNamedAndTheImuIsNotBlamed)
{
  const char* stand = std::get<0>(GetParam());
  const WrongRig& wrong = std::get<1>(GetParam());
  SCANLOOM_NEEDS_DATA(recording, std::string("recordings/") + stand);
  const TemporaryFolder folder;
  const auto input = openRig(rigOf(recording, wrong, folder));
  const Told told = localise(*input, folder / "run");

  const std::string said = wrong.said;
  EXPECT_EQ(told.passed, said.empty());
  ASSERT_EQ(told.warnings.empty(), said.empty());
  if (said.empty()) return;
  EXPECT_THAT(told.warnings.front(), HasSubstr(said));
  for (const std::string& warning : told.warnings) EXPECT_THAT(warning, testing::Not(HasSubstr("the IMU: ")));
}

INSTANTIATE_TEST_SUITE_P(
    OfBothStands, WrongRigs,
    testing::Combine(
        testing::Values("sparse", "dense"),
        testing::Values(WrongRig{"none", "1.5 1.2 2.5 30 15 -25", "", ""},
                        WrongRig{"yaw_2_deg", "1.5 1.2 2.5 32 15 -25", "", "the lidar 'right': "},
                        WrongRig{"yaw_5_deg", "1.5 1.2 2.5 35 15 -25", "",
                                 "the IMU of the lidar 'left': turn rates 5."},
                        WrongRig{"pitch_2_deg", "1.5 1.2 2.5 30 17 -25", "", "the lidar 'right': "},
                        WrongRig{"forward_half_a_metre", "2.0 1.2 2.5 30 15 -25", "", "move the sensor by (0.5"},
                        WrongRig{"sideways_half_a_metre", "1.5 1.7 2.5 30 15 -25", "", "the lidar 'right': "},
                        WrongRig{"the_other_way_round", "1.5 1.2 2.5 -150 -15 25", "", "the lidar 'left': "},
                        WrongRig{"altitudes_reversed", "1.5 1.2 2.5 30 15 -25", "reversed", "the lidar 'right': "},
                        WrongRig{"beams_of_another", "1.5 1.2 2.5 30 15 -25", "of another", "the lidar '"})),
    [](const auto& p) { return std::string(std::get<0>(p.param)) + "_" + std::get<1>(p.param).name; });
}  // namespace scanloom::wrong_rigs_unittest
