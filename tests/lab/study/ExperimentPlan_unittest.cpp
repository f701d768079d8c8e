#include "lab/study/ExperimentPlan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "lab/study/internal/RunHash.h"
#include "support/TemporaryFolder.h"
#include "support/messageOf.h"

namespace scanloom::experiment_plan_unittest
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kSlam = "[lidars]\npcap_input = $env{SCANLOOM_RECORDING}/recording.pcap\n";

class ExperimentPlanOf : public testing::Test
{
 protected:
  ExperimentPlanOf()
  {
    std::filesystem::create_directories(folder_ / "stands");
    std::filesystem::create_directories(folder_ / "drive");
    std::ofstream(folder_ / "stands/easy.ini") << "[simulated_drive]\nduration = 1\n";
    std::ofstream(folder_ / "stands/hard.ini") << "[simulated_drive]\nduration = 2\n";
    std::ofstream(folder_ / "slam.ini") << kSlam;
    std::ofstream(folder_ / "drive/recording.pcap") << "packets";
  }

  ExperimentPlan plan(const std::string& lines) const
  {
    const auto file = folder_ / "experiment.ini";
    std::ofstream(file) << "[experiment]\nconfigurations = slam.ini\n" << lines;
    const Configuration configuration = Configuration::fromFiles({file});
    ExperimentSettings settings;
    ExperimentSettings::sections(
        settings, [&](auto& options, const Section& section) { configuration.readInto(options, section); });
    return planOf(settings, configuration);
  }

  std::string complaintAbout(const std::string& lines) const
  {
    return messageOf<ConfigError>([&] { plan(lines); });
  }

  TemporaryFolder folder_;
};

std::vector<std::string> labelsOf(const ExperimentPlan& plan)
{
  std::vector<std::string> labels;
  for (const PlannedRun& run : plan.runs) labels.push_back(run.label());
  return labels;
}

TEST_F(ExperimentPlanOf, combinesEverythingWithTheSeedAsTheFastest)
{
  EXPECT_THAT(labelsOf(plan("simulations = stands/easy.ini stands/hard.ini\nlidars = left left,right\nevery_nth = 1 5\n"
                            "seeds = 7:8\n")),
              ElementsAre("easy left n1 seed 7", "easy left n1 seed 8", "easy left n5 seed 7", "easy left n5 seed 8",
                          "easy left+right n1 seed 7", "easy left+right n1 seed 8", "easy left+right n5 seed 7",
                          "easy left+right n5 seed 8", "hard left n1 seed 7", "hard left n1 seed 8",
                          "hard left n5 seed 7", "hard left n5 seed 8", "hard left+right n1 seed 7",
                          "hard left+right n1 seed 8", "hard left+right n5 seed 7", "hard left+right n5 seed 8"));
}

TEST_F(ExperimentPlanOf, variesAnyParameterByValuesWithBarsBetween)
{
  const ExperimentPlan two = plan(
      "simulations = stands/easy.ini\nlidars = left\nseeds = 1\n"
      "axis1_name = slam.imu\naxis1_values = left\naxis2_name = a.pose\naxis2_values = 0 0 1 | 0 0 2\n");

  ASSERT_EQ(two.runs.size(), 2U);
  EXPECT_THAT(two.runs[0].settings, ElementsAre(std::pair("slam.imu", "left"), std::pair("a.pose", "0 0 1")));
  EXPECT_THAT(two.runs[1].settings, ElementsAre(std::pair("slam.imu", "left"), std::pair("a.pose", "0 0 2")));
}

TEST_F(ExperimentPlanOf, holdsFixedWhatOtherSectionsSayUnlessAnAxisVariesIt)
{
  const ExperimentPlan two = plan(
      "simulations = stands/easy.ini\nlidars = left\nseeds = 1\n"
      "axis1_name = slam.imu\naxis1_values = left | right\n[Slam]\nIMU = body\ngate = 4\n");

  ASSERT_EQ(two.runs.size(), 2U);
  EXPECT_THAT(two.runs[0].settings, ElementsAre(std::pair("Slam.gate", "4"), std::pair("slam.imu", "left")));
  EXPECT_THAT(two.runs[1].settings, ElementsAre(std::pair("Slam.gate", "4"), std::pair("slam.imu", "right")));
}

TEST_F(ExperimentPlanOf, drawsNothingInRecordings)
{
  EXPECT_THAT(labelsOf(plan("recordings = drive\nlidars = left\nseeds = 1:10\n")), ElementsAre("drive left n1"));
}

TEST_F(ExperimentPlanOf, tellsRecordingsOfTheSameNameApart)
{
  std::filesystem::create_directories(folder_ / "monday");
  std::filesystem::create_directories(folder_ / "tuesday");
  std::ofstream(folder_ / "monday/drive.pcap.gz") << "packets";
  std::ofstream(folder_ / "tuesday/drive.pcap") << "packets";

  EXPECT_THAT(labelsOf(plan("recordings = monday/drive.pcap.gz tuesday/drive.pcap\n")),
              ElementsAre("monday drive all n1", "tuesday drive all n1"));
}

TEST_F(ExperimentPlanOf, takesAReferenceOrNoneForEachRecording)
{
  std::ofstream(folder_ / "survey.csv") << "t,x,y,z\n";
  const std::string two = "recordings = drive drive/recording.pcap\n";

  const ExperimentPlan given = plan(two + "references = none survey.csv\n");

  EXPECT_EQ(given.runs[0].reference, "none");
  EXPECT_EQ(given.runs[1].reference, folder_ / "survey.csv");
  EXPECT_THAT(complaintAbout(two + "references = survey.csv\n"), HasSubstr("for each of the 2 recordings"));
}

TEST_F(ExperimentPlanOf, findsFilesFromTheFolderOfTheFileThatNamesThem)
{
  EXPECT_EQ(plan("simulations = stands/easy.ini\n").runs[0].simulation, folder_ / "stands/easy.ini");
}

TEST_F(ExperimentPlanOf, namesFileLineAndWhatIsWrong)
{
  const std::string easy = "simulations = stands/easy.ini\n";
  EXPECT_THAT(complaintAbout("simulations = stands/esy.ini\n"),
              HasSubstr("experiment.ini:3: [experiment] simulations"));
  EXPECT_THAT(complaintAbout("simulations = stands/esy.ini\n"), HasSubstr("stands/esy.ini' does not exist"));
  EXPECT_THAT(complaintAbout(easy + "seeds = 5:1\n"), HasSubstr("experiment.ini:4: [experiment] seeds"));
  EXPECT_THAT(complaintAbout(easy + "seeds = 0\n"), HasSubstr("seeds"));
  EXPECT_THAT(complaintAbout(easy + "every_nth = 1 2.5\n"), HasSubstr("every_nth"));
  EXPECT_THAT(complaintAbout(easy + "axis1_name = a.b\n"), HasSubstr("axis1_name"));
  EXPECT_THAT(complaintAbout("lidars = left\n"), HasSubstr("recordings must name what runs"));
}

TEST_F(ExperimentPlanOf, hashesDifferWithAnythingThatTheResultDependsOn)
{
  const std::string lines = "simulations = stands/easy.ini\nlidars = left\nseeds = 1:2\n";
  const auto hash = [&](const ExperimentPlan& p, std::size_t run, const std::string& version = "1.0")
  { return configurationHash(p.runs[run], p, version); };
  const std::string before = hash(plan(lines), 0);
  EXPECT_EQ(hash(plan(lines + "every_nth = 1 5\n"), 0), before);  // what else runs does not matter

  EXPECT_NE(hash(plan(lines), 1), before);
  EXPECT_NE(hash(plan(lines), 0, "1.1"), before);
  EXPECT_NE(hash(plan(lines + "axis1_name = slam.imu\naxis1_values = left\n"), 0), before);
  std::ofstream(folder_ / "slam.ini") << kSlam << "[slam]\nrefine = false\n";
  EXPECT_NE(hash(plan(lines), 0), before);
  std::ofstream(folder_ / "slam.ini") << kSlam;
  EXPECT_EQ(hash(plan(lines), 0), before);
  std::ofstream(folder_ / "stands/easy.ini") << "[simulated_drive]\nduration = 3\n";
  EXPECT_NE(hash(plan(lines), 0), before);
}

TEST_F(ExperimentPlanOf, hashesOfRecordingsDifferWithTheirFilesAndTheReference)
{
  const std::string lines = "recordings = drive\n";
  const auto hash = [&](const ExperimentPlan& p) { return configurationHash(p.runs[0], p, "1.0"); };
  const std::string before = hash(plan(lines));
  EXPECT_NE(hash(plan(lines + "references = stands/easy.ini\n")), before);

  std::ofstream(folder_ / "drive/groundtruth.tum") << "1 0 0 0 0 0 0 1\n";
  EXPECT_NE(hash(plan(lines)), before);
}
}  // namespace
}  // namespace scanloom::experiment_plan_unittest
