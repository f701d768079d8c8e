/** `scanloom experiment` on recordings that a person brings, with a reference or without. */
#include "support/runProgram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>
#include <string>

#include "support/TemporaryFolder.h"
#include "support/TestData.h"

namespace scanloom::experiment_on_recordings_unittest
{
namespace
{
using testing::HasSubstr;
using testing::Not;

/** Links to a recording's files. */
void linkAllBut(const std::set<std::string>& left_out, const std::filesystem::path& recording,
                const std::filesystem::path& folder)
{
  std::filesystem::create_directories(folder);
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::canonical(recording)))
    if (const auto name = entry.path().filename(); left_out.count(name.string()) == 0)
      std::filesystem::create_symlink(entry.path(), folder / name);
}

/** A sweep of few runs over the recordings sparse and dense beside it, less the files that are left out of both. */
class OwnRecordings
{
 public:
  OwnRecordings(const std::filesystem::path& data, const std::set<std::string>& left_out,
                const std::string& lines = "lidars = left,right\n")
  {
    for (const char* name : {"sparse", "dense"}) linkAllBut(left_out, data / name, folder_ / name);
    std::ofstream(folder_ / "own.ini") << "[experiment]\nrecordings = sparse dense\nevery_nth = 15\n" << lines;
  }

  Ended run(const std::string& arguments = "") const
  {
    return scanloom("experiment -c " + (folder_ / "own.ini").string() + " --out-dir " + out().string() + " " +
                    arguments);
  }

  std::string report() const
  {
    EXPECT_EQ(scanloom("report " + out().string()).status, 0);
    return contentOf(out() / "report.html");
  }

  nlohmann::json runs() const { return nlohmann::json::parse(contentOf(out() / "results.json")).at("runs"); }
  std::filesystem::path out() const { return folder_ / "out"; }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  static Ended scanloom(const std::string& arguments)
  {
    return runProgram(SCANLOOM_BIN_DIR "/scanloom " + arguments + " 2>&1");
  }

  TemporaryFolder folder_;
};

TEST(ExperimentOnRecordings, comparesWithATotalStation)
{
  SCANLOOM_NEEDS_DATA(data, "recordings");
  const OwnRecordings own(data, {"groundtruth.tum"}, "lidars = left,right\n[output]\nmaps = false\n");

  const Ended ended = own.run();
  ASSERT_EQ(ended.status, 0) << ended.output;

  ASSERT_EQ(own.runs().size(), 2U);
  for (const auto& run : own.runs())
  {
    EXPECT_EQ(run.at("reference"), "total_station.csv at the prism");
    EXPECT_LT(run.at("figures").at("drift_imu_m"), 0.2);
    EXPECT_EQ(run.at("poses_ok_percent"), 100);
    EXPECT_FALSE(run.at("lost"));
  }
  EXPECT_THAT(own.report(), HasSubstr("Compared with total_station.csv at the prism."));
}

TEST(ExperimentOnRecordings, comparesWithPosesAlone)
{
  SCANLOOM_NEEDS_DATA(data, "recordings");
  const OwnRecordings own(data, {"total_station.csv"});

  const Ended ended = own.run();
  ASSERT_EQ(ended.status, 0) << ended.output;

  for (const auto& run : own.runs())
  {
    EXPECT_EQ(run.at("reference"), "groundtruth.tum");
    EXPECT_LT(run.at("figures").at("drift_imu_m"), 0.2);
    EXPECT_LT(run.at("figures").at("ape_rmse_m"), 0.05);
  }
}

TEST(ExperimentOnRecordings, judgesByHealthWithoutAReference)
{
  SCANLOOM_NEEDS_DATA(data, "recordings");
  const OwnRecordings own(data, {"total_station.csv", "groundtruth.tum"});

  const Ended ended = own.run();
  ASSERT_EQ(ended.status, 0) << ended.output;

  EXPECT_THAT(ended.output, HasSubstr("2 of 2 runs, 0 failed, 0 lost"));
  for (const auto& run : own.runs())
  {
    EXPECT_TRUE(run.at("figures").is_null());
    EXPECT_EQ(run.at("poses_ok_percent"), 100);
  }
  EXPECT_THAT(contentOf(own.out() / "results.csv"), HasSubstr(",OK,0,,,,,,,,,,,"));
  const std::string html = own.report();
  EXPECT_THAT(html, HasSubstr("There is no reference, so no drift"));
  EXPECT_THAT(html, HasSubstr("Medians of poses that are OK [%]"));
  EXPECT_THAT(html, Not(HasSubstr("Medians of drift")));
}

TEST(ExperimentOnRecordings, aRecordingIsAlsoOneFile)
{
  SCANLOOM_NEEDS_DATA(data, "recordings");
  const OwnRecordings own(data, {}, "references = dense/groundtruth.tum\n");

  const Ended ended =
      own.run("--dry-run --set experiment.recordings=" + (own.folder() / "dense/recording.pcap").string());

  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("/dense/recording.pcap\n# 0 simulations, 1 runs"));
  EXPECT_THAT(ended.output, Not(HasSubstr("--lidars")));  // all
}

TEST(ExperimentOnRecordings, aDryRunNamesAllMistakesWithKeyAndValue)
{
  SCANLOOM_NEEDS_DATA(data, "recordings");
  const OwnRecordings own(data, {},
                          "lidars = left middle\nreferences = none sparse/left.json\n"
                          "axis1_name = map_cells.cell_size\naxis1_values = 0.5 | -1\n"
                          "[slam]\nevery_nth = 2\n");

  for (const char* arguments : {"--dry-run", ""})
  {
    const Ended ended = own.run(arguments);
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.output, HasSubstr("own.ini: [experiment] lidars = middle, recordings = "));
    EXPECT_THAT(ended.output, HasSubstr("no lidar is called 'middle': known are 'left' and 'right'"));
    EXPECT_THAT(ended.output, HasSubstr("own.ini: [map_cells] cell_size = -1 m: must be between"));
    EXPECT_THAT(ended.output, HasSubstr("[slam] every_nth is a key of [experiment]"));
    EXPECT_THAT(ended.output, HasSubstr("[experiment] references = "));
    EXPECT_THAT(ended.output, HasSubstr("left.json:1: expected"));
    EXPECT_FALSE(std::filesystem::exists(own.out()));
  }
}

TEST(ExperimentOnRecordings, aDryRunReadsTheMetadataThatAConfigurationNames)
{
  SCANLOOM_NEEDS_DATA(data, "recordings");
  const OwnRecordings own(data, {"left.json"},
                          "lidars = all\nconfigurations = " SCANLOOM_SOURCE_DIR "/params/dual_os0_recording.ini\n");
  EXPECT_THAT(own.run("--dry-run").output, HasSubstr("sparse/left.json"));

  for (const char* name : {"sparse", "dense"}) std::ofstream(own.folder() / name / "left.json") << "{\"oops";
  const Ended ended = own.run("--dry-run");

  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.output, HasSubstr("recordings = " + (own.folder() / "dense").string()));
  EXPECT_THAT(ended.output, HasSubstr("dense/left.json"));
}
}  // namespace
}  // namespace scanloom::experiment_on_recordings_unittest
