#include "lab/study/StudyReport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lab/study/StudyRecords.h"

namespace scanloom::study_report_unittest
{
namespace
{
TEST(StudyReport, hasNoFigureWhereAllRunsFailed)
{
  const auto draw = [](const std::string&) -> std::string { throw std::logic_error("there is nothing to draw"); };
  const std::string html = htmlReport({"scanloom experiment", "a processor", {failedRun("no memory")}}, "", draw);
  EXPECT_THAT(html, testing::AllOf(testing::HasSubstr("No run came to its end"), testing::HasSubstr("no memory")));
}

TEST(StudyReport, namesTheMarkedEventsOfARecordingOnce)
{
  Study study;
  study.records = {runWithDrift(0.1, "left"), runWithDrift(0.2, "left,right"), runWithDrift(0.3, "right")};
  EXPECT_THAT(htmlReport(study, "", [](const std::string&) { return ""; }),
              testing::Not(testing::HasSubstr("Marked events")));
  for (RunRecord& record : study.records) record.marks = {{12.34, "a <deer>"}};
  const std::string html = htmlReport(study, "", [](const std::string&) { return ""; });
  const std::string row = "<tr><td>easy</td><td>12.3</td><td>a &lt;deer&gt;</td></tr>";
  ASSERT_THAT(html, testing::HasSubstr(row));
  EXPECT_EQ(html.find(row), html.rfind(row));
}
}  // namespace
}  // namespace scanloom::study_report_unittest
