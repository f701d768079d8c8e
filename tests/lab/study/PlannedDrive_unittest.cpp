#include "lab/study/PlannedDrive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "support/TemporaryFolder.h"

namespace scanloom::planned_drive_unittest
{
namespace
{
using testing::ElementsAre;

class Drives : public testing::Test
{
 protected:
  Drives() { std::ofstream(folder_ / "easy.ini") << "[simulated_drive]\n"; }

  PlannedRun run(std::uint64_t seed, const std::string& setting, const std::string& value) const
  {
    PlannedRun run;
    run.stand = "easy";
    run.simulation = folder_ / "easy.ini";
    run.lidars = "left";
    run.seed = seed;
    run.settings = {{setting, value}};
    return run;
  }

  TemporaryFolder folder_;
};

TEST_F(Drives, areSharedByRunsThatDifferInWhatSlamDoes)
{
  const auto drives = drivesOf(
      {run(1, "map_cells.cell_size", "1"), run(2, "map_cells.cell_size", "1"), run(1, "map_cells.cell_size", "2")},
      "1.0");

  ASSERT_EQ(drives.size(), 2U);
  EXPECT_THAT(drives[0].runs, ElementsAre(0, 2));
  EXPECT_THAT(drives[1].runs, ElementsAre(1));
  EXPECT_TRUE(drives[0].settings.empty());
  EXPECT_EQ(drives[1].label(), "easy seed 2");
}

TEST_F(Drives, differWithAnyParameterOfTheSimulation)
{
  const auto drives =
      drivesOf({run(1, "simulated_drive.duration", "1"), run(1, "Simulated_Drive.duration", "2")}, "1.0");

  ASSERT_EQ(drives.size(), 2U);
  EXPECT_THAT(drives[1].settings, ElementsAre(std::pair("Simulated_Drive.duration", "2")));
  EXPECT_NE(drives[0].hash, drives[1].hash);
}

TEST_F(Drives, changeTheirHashWithTheProgramAndTheStand)
{
  const auto hash = [&](const std::string& version) { return drivesOf({run(1, "a.b", "1")}, version).front().hash; };
  const std::string before = hash("1.0");
  EXPECT_EQ(hash("1.0"), before);
  EXPECT_NE(hash("1.1"), before);
  std::ofstream(folder_ / "easy.ini") << "[simulated_drive]\nduration = 2\n";
  EXPECT_NE(hash("1.0"), before);
}

TEST_F(Drives, onRecordingsAreNotShared)
{
  PlannedRun recorded;
  recorded.stand = "drive";
  recorded.recording = folder_.path();

  const auto drives = drivesOf({recorded, recorded}, "1.0");

  ASSERT_EQ(drives.size(), 2U);
  EXPECT_FALSE(drives[0].simulated());
}
}  // namespace
}  // namespace scanloom::planned_drive_unittest
