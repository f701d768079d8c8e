/** `scanloom experiment` and `scanloom report`, as a person or a script meets them. */
#include "support/runProgram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <string>
#include <vector>

#include "support/TemporaryFolder.h"

namespace scanloom::experiment_unittest
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;

Ended scanloom(const std::string& arguments) { return runProgram(SCANLOOM_BIN_DIR "/scanloom " + arguments + " 2>&1"); }

Ended experiment(const TemporaryFolder& folder, const std::string& arguments)
{
  return scanloom("experiment -c " SCANLOOM_SOURCE_DIR "/params/experiments/small.ini --out-dir " +
                  (folder / "sweep").string() + " " + arguments);
}

/** Of each run what does not depend on the machine. */
std::vector<std::string> outcomesOf(const TemporaryFolder& folder)
{
  std::vector<std::string> outcomes;
  const auto study = nlohmann::json::parse(contentOf(folder / "sweep/results.json"));
  for (const auto& run : study.at("runs"))
  {
    const auto& figures = run.at("figures");
    outcomes.push_back(run.at("lidars").get<std::string>() + " " + run.at("outcome").get<std::string>() + " " +
                       (figures.is_null() ? "" : figures.at("drift_m").dump()));
  }
  return outcomes;
}

/** A run that is not lost, within a metre; a lidar with 16 beams may leave a direction open. */
auto found(const std::string& lidars) { return testing::MatchesRegex(lidars + " (OK|DEGENERATE) 0\\..*"); }

TEST(ExperimentVerb, givesTheSameRowsInTheSameOrderWithAnyNumberOfJobs)
{
  const TemporaryFolder one, two;

  ASSERT_EQ(experiment(one, "--jobs 1").status, 0);
  ASSERT_EQ(experiment(two, "--jobs 2").status, 0);

  const std::vector<std::string> outcomes = outcomesOf(one);
  ASSERT_EQ(outcomes.size(), 2U);
  EXPECT_THAT(outcomes[0], found("left"));
  EXPECT_THAT(outcomes[1], HasSubstr("left,right OK 0."));
  EXPECT_EQ(outcomesOf(two), outcomes);
}

TEST(ExperimentVerb, keepsWhatIsDoneWhenItResumesAndWritesOverNothingUnasked)
{
  const TemporaryFolder folder;
  ASSERT_EQ(experiment(folder, "--set experiment.lidars=left").status, 0);
  EXPECT_EQ(experiment(folder, "").status, 2);

  const std::string results = contentOf(folder / "sweep/results.json");
  EXPECT_THAT(experiment(folder, "--resume --dry-run").output, HasSubstr("# done: "));
  ASSERT_EQ(experiment(folder, "--resume --set experiment.lidars=left").status, 0);
  EXPECT_EQ(contentOf(folder / "sweep/results.json"), results);  // down to the milliseconds
}

/** A drive that ends before there is a pose, then one that does not. (One lidar's drift of seed 1 is at the limit of
 * lost: the alignment on the first half metre of 5 m enlarges 3 cm to 0.3 m.) */
constexpr const char* kTooShort =
    "--set experiment.axis1_name=simulated_drive.duration --set 'experiment.axis1_values=0.05 | 20' "
    "--set experiment.lidars=left --set experiment.seeds=2";

TEST(ExperimentVerb, aFailedRunIsARowAndStatusFour)
{
  const TemporaryFolder folder;

  const Ended ended = experiment(folder, kTooShort);

  EXPECT_EQ(ended.status, 4) << ended.output;
  EXPECT_THAT(outcomesOf(folder), ElementsAre("left FAILED ", found("left")));
}

TEST(ExperimentVerb, aDriveThatCannotBeSimulatedIsARowForEachOfItsRuns)
{
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "sweep");
  std::ofstream(folder / "sweep/drives") << "a file in the place of the folder";

  const Ended ended = experiment(folder, "");

  EXPECT_EQ(ended.status, 4) << ended.output;
  EXPECT_THAT(outcomesOf(folder), ElementsAre("left FAILED ", "left,right FAILED "));
}

TEST(ExperimentVerb, refusesBeforeItStartsWhatItsRunsWouldEndWith)
{
  const TemporaryFolder folder;

  const Ended unknown_lidar = experiment(folder, "--set 'experiment.lidars=middle left'");
  EXPECT_EQ(unknown_lidar.status, 2);
  EXPECT_THAT(unknown_lidar.output, HasSubstr("[experiment] lidars = middle, simulations = "));
  EXPECT_THAT(unknown_lidar.output, HasSubstr("no lidar is called 'middle'"));

  const Ended unknown_model = experiment(folder,
                                         "--set experiment.axis1_name=simulated_lidars.lidar1_model --set "
                                         "'experiment.axis1_values=OS0-16 | OS9-16'");
  EXPECT_EQ(unknown_model.status, 2);
  EXPECT_THAT(unknown_model.output, HasSubstr("OS9-16"));
  EXPECT_FALSE(std::filesystem::exists(folder / "sweep"));
}

/** What lies in the folders of drives. */
std::vector<std::filesystem::path> packetsIn(const TemporaryFolder& folder)
{
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "sweep/drives"))
    if (entry.path().filename() == "recording.pcap") found.push_back(entry.path());
  return found;
}

TEST(ExperimentVerb, keepsPacketsOnlyIfAsked)
{
  const TemporaryFolder folder;

  ASSERT_EQ(experiment(folder, "--set experiment.lidars=left").status, 0);
  EXPECT_TRUE(packetsIn(folder).empty());
  ASSERT_EQ(experiment(folder, "-w --set experiment.lidars=left --set experiment.keep_packets=true").status, 0);
  EXPECT_EQ(packetsIn(folder).size(), 1U);
}

TEST(ExperimentVerb, aRunOnTheSharedPacketsEqualsSlamOfTheDriveWrittenAlone)
{
  const TemporaryFolder folder;
  ASSERT_EQ(experiment(folder, "--set experiment.lidars=left,right").status, 0);
  ASSERT_EQ(scanloom("simulate -c " SCANLOOM_SOURCE_DIR
                     "/params/simulation/sparse.ini --set simulated_drive.duration=20 --set "
                     "simulated_work.work_min=0 --set simulated_work.work_max=1 --out-dir " +
                     (folder / "recording").string())
                .status,
            0);
  setenv("SCANLOOM_RECORDING", (folder / "recording").c_str(), 1);
  ASSERT_EQ(
      scanloom("slam -c " SCANLOOM_SOURCE_DIR "/params/dual_os0_recording.ini --set output.maps=false --out-dir " +
               (folder / "alone").string())
          .status,
      0);

  const std::filesystem::path run = *std::filesystem::directory_iterator(folder / "sweep/runs");
  for (const char* name : {"trajectory.tum", "trajectory_imu.tum", "trajectory.csv"})
    EXPECT_EQ(contentOf(run / name), contentOf(folder / "alone" / name)) << name;
  EXPECT_FALSE(std::filesystem::exists(folder / "alone/map.ply"));
}

TEST(ExperimentVerb, aDryRunListsCommandsAndTimeAndWritesNothing)
{
  const TemporaryFolder folder;

  const Ended ended = experiment(folder, "--dry-run --jobs 1 --set experiment.seeds=1:3");

  EXPECT_EQ(ended.status, 0);
  EXPECT_THAT(ended.output, HasSubstr("simulate -c " SCANLOOM_SOURCE_DIR "/params/simulation/sparse.ini --seed 3"));
  EXPECT_THAT(ended.output, HasSubstr("--lidars left,right --every-nth 1"));
  EXPECT_THAT(ended.output, HasSubstr("# 3 simulations, 6 runs, about "));
  EXPECT_FALSE(std::filesystem::exists(folder / "sweep"));
}

TEST(ExperimentVerb, planSucceedsForEverySweepThatIsGiven)
{
  const TemporaryFolder folder;
  for (const auto& entry : std::filesystem::directory_iterator(SCANLOOM_SOURCE_DIR "/params/experiments"))
  {
    const Ended ended =
        scanloom("experiment -c " + entry.path().string() + " --dry-run --out-dir " + (folder / "sweep").string());
    EXPECT_EQ(ended.status, 0) << entry.path() << ": " << ended.output.substr(0, 1000);
  }
}

TEST(ExperimentVerb, refusesAParameterThatNoVerbHas)
{
  const TemporaryFolder folder;

  const Ended ended =
      experiment(folder, "--set experiment.axis1_name=map_cells.cell_sise --set experiment.axis1_values=1");

  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.output, HasSubstr("did you mean 'cell_size'"));
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(ReportVerb, isOneFileWithFiguresAndTheCommand)
{
  const TemporaryFolder folder;
  ASSERT_EQ(experiment(folder, kTooShort).status, 4);

  const Ended ended = scanloom("report " + (folder / "sweep").string());
  EXPECT_EQ(ended.status, 0) << ended.output;

  const std::string html = contentOf(folder / "sweep/report.html");
  for (const char* part :
       {"<svg", "aria-label=\"Medians of drift [m]: left, N = 1, duration = 0.05: -; left, N = 1, duration = 20: 0.",
        "scanloom experiment -c ", "<li>sparse left n1 seed 2: "})
    EXPECT_TRUE(contains(html, part)) << part;
  for (const char* part : {"<script", "src=", "http-equiv"}) EXPECT_FALSE(contains(html, part)) << part;
  EXPECT_EQ(scanloom("report " + (folder / "sweep").string()).status, 2);  // it exists
  EXPECT_EQ(scanloom("report " + folder.path().string()).status, 1);       // no experiment
}
}  // namespace
}  // namespace scanloom::experiment_unittest
