/** What is wrong with a rawlog, by faults put into a good one. */
#include "diagnosis/RawlogCheck.h"

#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/RawlogReport.h"
#include "mrpt/edit/internal/KeepEvery.h"
#include "mrpt/edit/internal/TimeOffset.h"
#include "mrpt/edit/smallRawlog.h"
#include "support/peakMemory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace scanloom::rawlog_check_unittest
{
namespace
{
struct RawlogCheck : testing::Test
{
  TemporaryFolder folder;
  std::filesystem::path in = folder / "in.rawlog";

  /** 20 scans, none empty. */
  void SetUp() override
  {
    RawlogWriter writer(in, someHeader());
    for (int i = 0; i < 20; ++i)
    {
      const Timestamp start = kSmallStart + i * 100ms;
      for (const Duration after : {10ms, 60ms})
        writer.write(*toObservation(ImuSample{start + after, {}, {}}, Rigid::identity()));
      writer.write(*toObservation(someScan(start)));
    }
    writer.close();
  }

  RawlogAccount account() const
  {
    return accountOf(in, [](std::uint64_t) { return true; });
  }

  Verdict verdictOf(const std::string& about, const std::string& measure) const
  {
    for (const Finding& finding : findingsOf(account()))
      if (finding.about == about && finding.measure == measure) return finding.verdict;
    throw std::runtime_error("no finding " + about + " " + measure);
  }

  /** Changes the rawlog by a function of each observation and its number among those of its label. */
  template <typename Change>
  void spoil(const Change& change) const
  {
    edited(
        in,
        [change, numbers = std::map<std::string, int>()](const ObservationPtr& o) mutable -> Observations
        { return o ? change(o, numbers[o->sensorLabel]++) : Observations{}; },
        in);
  }
};

TEST_F(RawlogCheck, aGoodRawlogIsFit)
{
  EXPECT_EQ(worstOf(findingsOf(account())), Verdict::Ok);
  const LabelAccount lidar = account().labels.at("lidar");
  EXPECT_EQ(lidar.count, 20u);
  EXPECT_EQ(lidar.usual_interval, 100ms);
  EXPECT_EQ(lidar.of_clouds.points, 2400u);
  EXPECT_EQ(lidar.of_clouds.lidars.at(1).points, 1200u);
  EXPECT_EQ(lidar.of_clouds.lidars.at(1).columns, 400u);
}

TEST_F(RawlogCheck, missingScansAreGaps)
{
  spoil([](const ObservationPtr& o, int i)
        { return o->sensorLabel == "lidar" && (i == 7 || i == 8) ? Observations{} : Observations{o}; });
  const LabelAccount lidar = account().labels.at("lidar");
  EXPECT_EQ(lidar.gaps, 1u);
  EXPECT_EQ(lidar.lost, 2u);
  EXPECT_EQ(lidar.longest_interval, 300ms);
  EXPECT_EQ(verdictOf("lidar", "gaps"), Verdict::NotFit) << "one in ten";
}

TEST_F(RawlogCheck, stampsThatGoBackAreNotFit)
{
  spoil(
      [](const ObservationPtr& o, int i)
      {
        if (o->sensorLabel == "imu" && i >= 20) o->timestamp -= mrpt::Clock::duration(2'000'000);  // 0.2 s
        return Observations{o};
      });
  EXPECT_EQ(account().labels.at("imu").backwards, 1u);
  EXPECT_EQ(verdictOf("imu", "order"), Verdict::NotFit);
}

TEST_F(RawlogCheck, pointsOutsideOfTheirScanAreNotFit)
{
  spoil(
      [](const ObservationPtr& o, int i)
      {
        if (o->sensorLabel == "lidar" && i == 3)
          for (float& t : *dynamic_cast<mrpt::maps::CGenericPointsMap&>(*cloudIn(o)->pointcloud)
                               .getPointsBufferRef_float_field("t"))
            t += 0.05f;
        return Observations{o};
      });
  EXPECT_EQ(account().labels.at("lidar").of_clouds.outside, 57u) << "19 columns of three points were later than 50 ms";
  EXPECT_EQ(verdictOf("lidar", "point times"), Verdict::NotFit);
}

TEST_F(RawlogCheck, aLidarThatFallsSilentLacksColumns)
{
  spoil(
      [](const ObservationPtr& o, int i)
      {
        auto cloud = o->sensorLabel == "lidar" ? cloudIn(o) : nullptr;
        if (cloud && i >= 5 && i < 7)
          for (std::uint8_t& id : *dynamic_cast<mrpt::maps::CGenericPointsMap&>(*cloud->pointcloud)
                                       .getPointsBufferRef_uint8_field("sensor_id"))
            id = 0;
        return Observations{o};
      });
  const LidarShare right = account().labels.at("lidar").of_clouds.lidars.at(1);
  EXPECT_EQ(right.silent_scans, 2u);
  EXPECT_EQ(right.missing_columns, 40u);
  EXPECT_EQ(verdictOf("lidar right", "columns"), Verdict::Warning);
}

TEST_F(RawlogCheck, samplesThatComeAfterTheirScanAreLate)
{
  spoil(
      [](const ObservationPtr& o, int)
      {
        if (o->sensorLabel == "imu") o->timestamp -= mrpt::Clock::duration(500'000);  // 50 ms, in place
        return Observations{o};
      });
  EXPECT_EQ(account().late_imu, 19u) << "the first of two, behind every scan but the last";
}

TEST_F(RawlogCheck, pointsThatNoLidarMeasuresAreCountedAndLeftOut)
{
  spoil(
      [](const ObservationPtr& o, int i)
      {
        const auto cloud = o->sensorLabel == "lidar" ? cloudIn(o) : nullptr;
        if (cloud && i >= 3 && i < 6)
          for (const float nowhere : {std::numeric_limits<float>::quiet_NaN(), 1e30F})
            cloud->pointcloud->setPointFast(static_cast<std::size_t>(2 * i + (nowhere > 0)), nowhere, 1, 1);
        return Observations{o};
      });
  EXPECT_EQ(account().labels.at("lidar").of_clouds.impossible, 6u);
  EXPECT_EQ(verdictOf("lidar", "points"), Verdict::Warning);
  const CheckedRawlog check = checkRawlog(in, {}, [](std::uint64_t) { return true; });
  EXPECT_EQ(check.rig.lidars.size(), 2u) << "it also ends";
}

TEST_F(RawlogCheck, oneStampOfNextYearTakesNoMemory)
{
  for (const std::string label : {"imu", "lidar"})
  {
    const long before = peakMegabytes();
    spoil(
        [&](const ObservationPtr& o, int i)
        {
          if (o->sensorLabel == label && i == 19) o->timestamp += mrpt::Clock::duration(365 * 864'000'000'000);
          return Observations{o};
        });
    const CheckedRawlog check = checkRawlog(in, {}, [](std::uint64_t) { return true; });
    EXPECT_EQ(check.account.labels.at(label).gaps, 1u);
    EXPECT_LT(peakMegabytes() - before, 50) << label;
  }
}

TEST_F(RawlogCheck, damageAndAMissingHeaderAreNotFit)
{
  std::filesystem::resize_file(in, std::filesystem::file_size(in) / 2);
  EXPECT_EQ(verdictOf("rawlog", "file"), Verdict::NotFit);
  spoil([](const ObservationPtr& o, int) { return o->sensorLabel.empty() ? Observations{} : Observations{o}; });
  EXPECT_EQ(verdictOf("rawlog", "header"), Verdict::NotFit);
}

TEST_F(RawlogCheck, aLabelThatIsNoTextIsToldAllTheSame)
{
  spoil(
      [](const ObservationPtr& o, int i)
      {
        if (i == 3) o->sensorLabel = "\xC3(";
        return Observations{o};
      });
  const auto json = nlohmann::json::parse(toJson(checkRawlog(in, {}, [](std::uint64_t) { return true; })));
  EXPECT_EQ(json["rawlog"]["labels"]["?("]["count"], 2);
  EXPECT_NO_THROW(toJson(rawlogInfo(in)));
}

TEST_F(RawlogCheck, aHeaderWithoutLidarsHarmsNothing)
{
  {
    RawlogWriter writer(in, RecordingHeader{});
    for (int i = 0; i < 3; ++i) writer.write(*toObservation(someScan(kSmallStart + i * 100ms)));
    writer.close();
  }
  const CheckedRawlog check = checkRawlog(in, {}, [](std::uint64_t) { return true; });
  EXPECT_TRUE(check.rig.lidars.empty());
  EXPECT_EQ(check.account.labels.at("lidar").of_clouds.points, 360u);
}

TEST_F(RawlogCheck, isToldAsJson)
{
  const auto json = nlohmann::json::parse(toJson(account()));
  EXPECT_EQ(json["labels"]["lidar"]["lidars"]["right"]["columns"], 400);
  EXPECT_DOUBLE_EQ(json["labels"]["imu"]["usual_interval_s"], 0.05);
}
}  // namespace
}  // namespace scanloom::rawlog_check_unittest
