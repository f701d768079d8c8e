#include "lab/study/internal/Study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lab/study/StudyRecords.h"
#include "support/TemporaryFolder.h"

namespace scanloom::study_unittest
{
namespace
{
using testing::ElementsAre;

const Quantity kDrift{"drift [m]",
                      [](const RunRecord& record) -> std::optional<double>
                      {
                        if (!record.figures) return std::nullopt;
                        return record.figures->drift;
                      }};

CellSummary summaryOfDrifts(const std::vector<double>& drifts, const Quantity& quantity = kDrift)
{
  std::vector<RunRecord> records;
  for (const double drift : drifts) records.push_back(runWithDrift(drift));
  records.push_back(failedRun("no memory"));
  return summaryOf(cellsOf(records).front(), quantity);
}

TEST(Study, lostRunsAreWorseThanAllOthersAndFailedOnesAreNone)
{
  const CellSummary summary = summaryOfDrifts({1, 30, 3, 2, 40});

  EXPECT_THAT(summary.values, ElementsAre(1, 3, 2));
  EXPECT_EQ(summary.lost, 2U);
  EXPECT_EQ(summary.failed, 1U);
  EXPECT_EQ(*summary.median(), 3);
  EXPECT_EQ(*summaryOfDrifts({1, 2, 4, 30}).median(), 3);
}

TEST(Study, aMedianCanBeLostOrMissing)
{
  EXPECT_TRUE(summaryOfDrifts({1, 30, 40}).medianIsLost());
  EXPECT_TRUE(summaryOfDrifts({1, 30}).medianIsLost());  // between 1 and lost
  EXPECT_FALSE(summaryOfDrifts({1, 30}).median());
  EXPECT_FALSE(summaryOfDrifts({}).medianIsLost());
  EXPECT_FALSE(summaryOfDrifts({}).median());
}

TEST(Study, aRunWithoutAReferenceHasNoDriftButIsNoFailure)
{
  RunRecord not_compared = runWithDrift(0), lost = not_compared;
  not_compared.figures.reset();
  lost.figures.reset();
  lost.outcome = "LOST";
  const std::vector<RunRecord> records{not_compared, lost};

  const CellSummary drift = summaryOf(cellsOf(records).front(), kDrift);

  EXPECT_TRUE(drift.empty());
  EXPECT_EQ(drift.failed, 0U);
  EXPECT_FALSE(drift.median());
  EXPECT_FALSE(not_compared.lost());
  EXPECT_TRUE(lost.lost());
}

TEST(Study, whatLostRunsCostCountsLikeThatOfOthers)
{
  Quantity cost = kDrift;
  cost.lost = LostRuns::LikeOthers;

  EXPECT_EQ(*summaryOfDrifts({1, 30, 40}, cost).median(), 30);
}

TEST(Study, cellsHoldAllSeedsOfACombinationAndNameWhatVaries)
{
  std::vector<RunRecord> records{runWithDrift(1, "left", 5, 1), runWithDrift(1, "left", 5, 2),
                                 runWithDrift(1, "left,right", 5, 1), runWithDrift(1, "left", 5, 1)};
  for (RunRecord& record : records) record.run.settings = {{"slam.imu", "auto"}, {"map_cells.cell_size", "1"}};
  records[3].run.settings[1].second = "2";

  const std::vector<StudyCell> cells = cellsOf(records);

  ASSERT_EQ(cells.size(), 3U);
  EXPECT_EQ(cells[0].group, "N = 5, cell_size = 1");
  EXPECT_EQ(cells[0].records.size(), 2U);
  EXPECT_EQ(cells[1].lidars, "left,right");
  EXPECT_EQ(cells[2].group, "N = 5, cell_size = 2");
}

TEST(Study, isReadAsItWasWritten)
{
  const TemporaryFolder folder;

  writeStudy(folder.path(), {"scanloom experiment", "a processor, 2 cores", {runWithDrift(0.5), failedRun("why")}});
  const Study study = readStudy(folder.path());

  EXPECT_EQ(study.command, "scanloom experiment");
  EXPECT_EQ(study.machine, "a processor, 2 cores");
  ASSERT_EQ(study.records.size(), 2U);
  EXPECT_EQ(study.records[0].figures->drift, 0.5);
  EXPECT_EQ(study.records[1].error, "why");
  EXPECT_TRUE(std::filesystem::exists(folder / "results.csv"));
  EXPECT_THROW(readStudy(folder / "elsewhere"), std::runtime_error);
}
}  // namespace
}  // namespace scanloom::study_unittest
