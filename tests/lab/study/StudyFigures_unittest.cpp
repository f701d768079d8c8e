#include "lab/study/internal/StudyFigures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lab/study/StudyRecords.h"

namespace scanloom::study_figures_unittest
{
namespace
{
using testing::HasSubstr;
using testing::Not;

const Quantity kDrift{"drift [m]", [](const RunRecord& record) { return std::optional(record.figures->drift); }};

TEST(StudyFigures, barsStandSideBySideInGroupsOfN)
{
  const std::vector<RunRecord> records{runWithDrift(1, "left", 1), runWithDrift(2, "left,right", 1),
                                       runWithDrift(3, "left", 5), runWithDrift(4, "left,right", 5)};

  const std::string script = barsScript(barsOf(cellsOf(records), kDrift), "drift [m]");

  EXPECT_THAT(script, HasSubstr("$median0 << EOD\n0 1\n3 3\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("$median1 << EOD\n1 2\n4 4\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("set xtics ('N = 1' 0.50, 'N = 5' 3.50)"));
  EXPECT_THAT(script, HasSubstr("set ylabel 'drift [m]'"));
  EXPECT_THAT(script, Not(HasSubstr("\"lost\"")));
}

RunRecord runWithCellSize(const std::string& size, const std::string& lidars)
{
  RunRecord record = runWithDrift(1, lidars);
  record.run.settings = {{"map_cells.cell_size", size}};
  return record;
}

TEST(StudyFigures, namesOfSettingsStandOnceBelowTheirValues)
{
  const std::vector<RunRecord> records{runWithCellSize("0.5", "left"), runWithCellSize("1", "left")};

  const std::string script = barsScript(barsOf(cellsOf(records), kDrift), "drift [m]");

  EXPECT_THAT(script, HasSubstr("set xtics ('1, 0.5' 0.00, '1, 1' 2.00)"));
  EXPECT_THAT(script, HasSubstr("set xlabel 'N, cell_size'"));
}

TEST(StudyFigures, moreLinesThanDashesAreSplitByLidars)
{
  std::vector<RunRecord> records;
  for (const char* lidars : {"left", "right"})
    for (const char* size : {"1", "2", "3", "4", "5"}) records.push_back(runWithCellSize(size, lidars));
  EXPECT_EQ(byLines(cellsOf(records)).size(), 1U);

  for (const char* lidars : {"left", "right"}) records.push_back(runWithCellSize("6", lidars));
  const std::vector<StudyCell> cells = cellsOf(records);
  const auto figures = byLines(cells);
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_EQ(figures[1].size(), 6U);
  EXPECT_EQ(figures[1].front().lidars, "right");
}

TEST(StudyFigures, lostRunsAreAboveAllOthersAndALostMedianIsHatched)
{
  const std::vector<RunRecord> records{runWithDrift(5, "left", 1, 1), runWithDrift(50, "left", 1, 2),
                                       runWithDrift(50, "left", 1, 3)};

  const std::string script = barsScript(barsOf(cellsOf(records), kDrift), "drift [m]");

  EXPECT_THAT(script, HasSubstr("$median0 << EOD\nNaN NaN\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("$hatched0 << EOD\n0 5.6\nEOD\n"));  // 12 % above the largest that is not lost
  EXPECT_THAT(script, HasSubstr("$dots0 << EOD\n0.0000 5\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("$lost0 << EOD\n-0.1333 5.6\n0.1333 5.6\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("set label \"lost\""));
}

TEST(StudyFigures, gnuplotIsGivenARangeWhereAllRunsAreLost)
{
  const std::vector<RunRecord> lost{runWithDrift(50, "left", 1, 1)};
  EXPECT_THAT(driftOverDistanceScript(cellsOf(lost)), HasSubstr("set xrange [0:1]\nset yrange [0:1]"));
}

TEST(StudyFigures, errorsOverTheDistanceAreMediansOfTheRunsThatWereNotLost)
{
  const std::vector<RunRecord> records{runWithDrift(1, "left", 1, 1), runWithDrift(2, "left", 1, 2),
                                       runWithDrift(4, "left", 1, 3), runWithDrift(50, "left", 1, 4)};

  const std::vector<ErrorAtDistance> medians = medianOverDistance(cellsOf(records).front());

  ASSERT_EQ(medians.size(), 20U);
  EXPECT_EQ(medians[0].distance, 50);
  EXPECT_EQ(medians[0].error, 0);
  EXPECT_EQ(medians[8].error, 0);  // to 450 m
  EXPECT_EQ(medians[9].distance, 500);
  EXPECT_EQ(medians[9].error, 1);
  EXPECT_EQ(medians[18].error, 1);  // the vertex at 500 m stands for all up to the next one
  EXPECT_EQ(medians[19].distance, 1000);
  EXPECT_EQ(medians[19].error, 2);
}
}  // namespace
}  // namespace scanloom::study_figures_unittest
