#include "run/run/internal/RunSummary.h"

#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace scanloom::run_summary_unittest
{
namespace
{
TEST(RunSummary, isJsonWithUnitsInItsNames)
{
  RunSummary run;
  run.outcome = "OK";
  run.counts["scans"] = 300;
  run.recorded = 30;
  run.elapsed = 10;
  run.stages["registration"].add(10);
  run.stages["registration"].add(30);
  const TemporaryFolder folder;
  writeSummary(folder / "summary.json", run);

  const auto json = nlohmann::json::parse(contentOf(folder / "summary.json"));

  EXPECT_EQ(json["outcome"], "OK");
  EXPECT_EQ(json["counts"]["scans"], 300);
  EXPECT_DOUBLE_EQ(json["real_time_factor"], 3.0);
  EXPECT_DOUBLE_EQ(json["stages"]["registration"]["mean_ms"], 20.0);
  EXPECT_NEAR(json["stages"]["registration"]["p95_ms"], 30.0, 1.5);
  EXPECT_DOUBLE_EQ(json["stages"]["registration"]["max_ms"], 30.0);
}

TEST(RunSummary, doesNotCountTheTimeLiveInWhichThereWasNothingToDo)
{
  RunSummary run;
  run.recorded = 30;
  run.elapsed = 31;
  run.waited = 21;

  EXPECT_DOUBLE_EQ(run.realTimeFactor(), 3.0);
}

TEST(RunSummary, seesMemoryThatWasTouched)
{
  const std::uint64_t before = peakMemory();
  const std::vector<char> touched(200'000'000, 'x');

  EXPECT_GT(peakMemory(), before + 100'000'000) << touched[before % touched.size()];
}
}  // namespace
}  // namespace scanloom::run_summary_unittest
