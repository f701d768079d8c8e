#include "lab/study/internal/RunRecord.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>

#include "lab/study/StudyRecords.h"

namespace scanloom::run_record_unittest
{
namespace
{
TEST(RunRecord, isLostBeyondTenMetresOrFivePercentOrByItsOwnAccount)
{
  EXPECT_FALSE(runWithDrift(9.9).lost());
  EXPECT_TRUE(runWithDrift(10.1).lost());

  RunRecord on_a_short_path = runWithDrift(1);
  on_a_short_path.figures->path = 19.9;
  EXPECT_TRUE(on_a_short_path.lost());
  on_a_short_path.figures->path = 20.1;
  EXPECT_FALSE(on_a_short_path.lost());

  RunRecord on_chords_only = runWithDrift(11);
  on_chords_only.figures->imu_rate_drift = 0.5;
  EXPECT_FALSE(on_chords_only.lost());

  RunRecord by_its_own_account = runWithDrift(0.1);
  by_its_own_account.outcome = "LOST";
  EXPECT_TRUE(by_its_own_account.lost());
}

TEST(RunRecord, isTheSameAfterJson)
{
  RunRecord record = runWithDrift(0.25, "left,right", 5, 3);
  record.run.settings = {{"slam.imu", "left"}};
  record.figures->imu_rate_drift = 0.125;
  record.marks = {{12.5, "a deer"}};

  for (const RunRecord& original : {record, failedRun("status 1, \"no\" memory")})
  {
    const nlohmann::json json = original;
    EXPECT_EQ(nlohmann::json(json.get<RunRecord>()), json);
  }
  EXPECT_EQ(nlohmann::json(record).get<RunRecord>().marks.at(0).text, "a deer");
  EXPECT_EQ(*nlohmann::json(record).get<RunRecord>().figures->imu_rate_drift, 0.125);
}

TEST(RunRecord, isALineOfCsvWithEmptyCellsForWhatARunHasNot)
{
  RunRecord dual = runWithDrift(0.25, "left,right", 5, 3), failed = failedRun("status 1, \"no\" memory");
  dual.run.settings = failed.run.settings = {{"slam.imu", "auto"}};

  std::ostringstream csv;
  writeCsv(csv, {dual, failed});

  EXPECT_EQ(
      csv.str(),
      "version,configuration,stand,lidars,every_nth,slam.imu,seed,outcome,lost,drift_m,drift_percent,drift_imu_m,"
      "drift_floor_m,final_m,ape_rmse_m,rpe_rmse_m,rpe_rmse_deg,path_m,samples,real_time_factor,peak_memory_mb,"
      "elapsed_s,ms_smoother,poses_ok_percent,reference,error\n"
      "1.0,0123,easy,\"left,right\",5,auto,3,OK,0,0.2500,0.025,,,0.0000,0.0000,,,1000.00,0,4.00,200,0.0,0.500,,,\n"
      "1.0,0123,easy,left,1,auto,1,FAILED,0,,,,,,,,,,,,,,,,,\"status 1, \"\"no\"\" memory\"\n");
}

TEST(RunRecord, hasEmptyCellsInsteadOfZerosWithoutAReference)
{
  RunRecord record = runWithDrift(0.25);
  record.figures.reset();
  record.ok_percent = 97.5;

  std::ostringstream csv;
  writeCsv(csv, {record});

  EXPECT_THAT(csv.str(), testing::EndsWith("\n1.0,0123,easy,left,1,1,OK,0,,,,,,,,,,,4.00,200,0.0,0.500,97.5,,\n"));
  EXPECT_EQ(nlohmann::json(record).get<RunRecord>().ok_percent, 97.5);
  EXPECT_FALSE(nlohmann::json(record).get<RunRecord>().figures);
}
}  // namespace
}  // namespace scanloom::run_record_unittest
