/** How a run ends that cannot go on. */
#include "run/run/SlamRun.h"
#include "run/run/SlamFiles.h"

#include "base/core/OutputFile.h"
#include "base/formats/Trajectory.h"
#include "estimation/slam/StandOfStems.h"
#include "support/FullDisk.h"
#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <deque>
#include <new>
#include <sstream>
#include <stdexcept>

namespace scanloom::slam_run_unittest
{
namespace
{
using testing::HasSubstr;

constexpr int kEnough = 40;  // scans: the start takes 20

/** A lidar at rest in a stand, whose input breaks after some scans. */
class BrokenInput : public SensorInput
{
 public:
  BrokenInput(int scans, std::function<void()> fail, int marked_scan = -1, Duration imu_late = 0s)
    : fail_(std::move(fail))
  {
    setup_.header.lidars.resize(1);
    setup_.header.lidars[0].name = "left";
    setup_.header.lidars[0].body_T_sensor = Rigid::fromXyzYawPitchRoll(0, 0, 3, 0, 0, 0);
    setup_.body_T_imu[SensorImu::kBody] = Rigid::identity();
    const Scan scan = StandOfStems().scanAt(Timestamp{0ms}, [](Timestamp) { return Rigid::identity(); });
    for (int i = 0; i < scans; ++i)
    {
      const Timestamp start{i * 100ms};
      for (Duration t{0}; t < 100ms; t += 5ms)
      {
        const double noise = 1e-4 * std::sin(seconds(start.time_since_epoch() + t) * 700);  // constant ones are refused
        events_.push_back(SensorImu{SensorImu::kBody, {start + t + imu_late, {noise, 0, 0}, {0, noise, 9.80665}}});
      }
      events_.push_back(shifted(scan, start));
      if (i == marked_scan) events_.push_back(EventMark{start + 100ms, "a deer, left"});
    }
  }

  std::optional<SensorEvent> next(Duration) override
  {
    if (events_.empty()) fail_();
    std::optional<SensorEvent> event(std::move(events_.front()));
    events_.pop_front();
    return event;
  }
  bool ended() const override { return false; }
  void stop() override {}
  SensorSetup setup() const override { return setup_; }

 private:
  static Scan shifted(Scan scan, Timestamp start)
  {
    for (Column& column : scan.columns) column.stamp += start - scan.start;
    scan.start = start;
    return scan;
  }

  SensorSetup setup_;
  std::function<void()> fail_;

 protected:
  std::deque<SensorEvent> events_;
};

/** Ends where its events end. */
class WholeInput : public BrokenInput
{
 public:
  explicit WholeInput(Duration imu_late)
    : BrokenInput(
          kEnough, [] {}, -1, imu_late)
  {
  }
  bool ended() const override { return events_.empty(); }
};

struct BrokenRun : testing::Test
{
  TemporaryFolder folder;

  SlamRunResult run(int scans, const std::function<void()>& fail, int marked_scan = -1) const
  {
    BrokenInput input(scans, fail, marked_scan);
    SlamFiles files(folder.path(), input.setup().header.lidars, OutputOptions{false, "", 0});
    SlamRunResult result = runSlam(
        input, {}, [&](const StateEstimate& estimate) { files.add(estimate); }, [](const RunProgress&) { return true; },
        [](const std::string&) {}, [&](const EventMark& mark) { files.add(mark); });
    result.summary = files.close(result.summary);
    return result;
  }
};

TEST_F(BrokenRun, keepsThePosesSoFarAndTellsWhatEndedIt)
{
  const SlamRunResult result = run(kEnough, [] { throw std::runtime_error("the disk is gone"); });
  EXPECT_FALSE(result.passed);
  const std::size_t poses = readTum(folder / "trajectory.tum").size();
  EXPECT_GT(poses, 5u);

  const auto summary = nlohmann::json::parse(contentOf(folder / "summary.json"));
  EXPECT_EQ(summary["outcome"], "FAILED");
  EXPECT_EQ(summary["error"], "the disk is gone");
  EXPECT_EQ(summary["counts"]["poses"], poses);
}

TEST_F(BrokenRun, hasTheMarksOfThePersonAtTheirTimes)
{
  run(
      kEnough, [] { throw std::runtime_error("the end"); }, 30);
  const std::string csv = contentOf(folder / "trajectory.csv");
  std::istringstream lines(csv);
  std::vector<std::string> marked;
  for (std::string line; std::getline(lines, line);)
    if (line.find("deer") != std::string::npos) marked.push_back(line);
  ASSERT_EQ(marked.size(), 1U) << csv;
  EXPECT_THAT(marked[0], testing::StartsWith("3100000000,"));
  EXPECT_THAT(marked[0], testing::EndsWith(",a deer  left")) << "without the comma, which would end the column";

  const auto summary = nlohmann::json::parse(contentOf(folder / "summary.json"));
  ASSERT_EQ(summary["marks"].size(), 1U);
  EXPECT_NEAR(summary["marks"][0]["after_s"], 3.1, 1e-9);
  EXPECT_EQ(summary["marks"][0]["text"], "a deer, left");
}

TEST_F(BrokenRun, saysThatMemoryDidNotSuffice)
{
  const SlamRunResult result = run(kEnough, [] { throw std::bad_alloc(); });
  EXPECT_THAT(result.summary.error, HasSubstr("not enough memory"));
}

TEST_F(BrokenRun, keepsThePosesThatAFullDiskTook)
{
  SlamRunResult result;
  {
    const FullDisk full(20'000);
    result = run(kEnough, [] { throw std::logic_error("the disk was full before"); });
  }
  EXPECT_EQ(result.summary.outcome, "FAILED");
  EXPECT_THAT(result.summary.error, HasSubstr(": cannot be written: "));
  EXPECT_GT(readTum(folder / "trajectory.tum").size(), 3u);
  EXPECT_GT(readTum(folder / "trajectory_imu.tum").size(), 100u) << "its last line may have been cut";
}

TEST(SlamRun, namesAnImuOfAnotherClockByHowMuchAndDoesNotPass)
{
  for (const Duration late : {-37s, 0s, 1000s})
  {
    WholeInput input(late);
    std::vector<std::string> warnings;
    const SlamRunResult result = runSlam(
        input, {}, [](const StateEstimate&) {}, [](const RunProgress&) { return true; },
        [&](const std::string& warning) { warnings.push_back(warning); });
    const auto told = testing::Contains(HasSubstr(fmt::format(
        "the IMU 'body' is not used, its clock is another one: its samples begin {:.1f} s", std::abs(seconds(late)))));
    if (late == 0s)
      EXPECT_THAT(warnings, testing::Not(told));
    else
      EXPECT_THAT(warnings, told);
    EXPECT_EQ(result.passed, late == 0s);
  }
}

TEST_F(BrokenRun, tellsBeforeItsFirstPoseWhatEndedItAndWhatHadCome)
{
  EXPECT_FALSE(run(2, [] { throw std::runtime_error("the disk is gone"); }).passed);
  const auto summary = nlohmann::json::parse(contentOf(folder / "summary.json"));
  EXPECT_EQ(summary["outcome"], "FAILED");
  EXPECT_EQ(summary["error"], "the disk is gone");
  EXPECT_EQ(summary["counts"]["scans"], 2);
}

TEST_F(BrokenRun, hasNothingToKeepBeforeItsFirstScan)
{
  EXPECT_THROW(run(0, [] { throw std::runtime_error("the disk is gone"); }), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

/** Points of lidars 0 and 1 in a ring around the body. */
Keyframe keyframeOf(Timestamp stamp, std::uint8_t most_sensor_id)
{
  Keyframe keyframe{stamp, Rigid::identity(), {}};
  keyframe.points.resize(100);
  for (std::size_t i = 0; i < 100; ++i)
  {
    keyframe.points.x[i] = static_cast<float>(5 * std::cos(0.06 * static_cast<double>(i)));
    keyframe.points.y[i] = static_cast<float>(5 * std::sin(0.06 * static_cast<double>(i)));
    keyframe.points.z[i] = 1;
    keyframe.points.sensor_id[i] = static_cast<std::uint8_t>(i % (most_sensor_id + 1U));
  }
  return keyframe;
}

TEST(SlamMaps, thatCannotBeDrawnLeaveTheOthersWholeAndAreNamed)
{
  const TemporaryFolder folder;
  RunSummary summary;
  {
    std::vector<RecordedLidar> one(1);
    SlamMaps maps(folder.path(), one, CloudClass::CGenericPointsMap);
    maps.add({keyframeOf(Timestamp{1s}, 0)}, {});
    maps.add({keyframeOf(Timestamp{2s}, 1)}, {});  // keyframes.simplemap knows no lidar 1
    maps.add({keyframeOf(Timestamp{3s}, 0)}, {});
    maps.close({{Timestamp{1s}, Rigid::identity()}}, summary);
  }
  EXPECT_EQ(summary.counts.at("map_points"), 300u);
  EXPECT_TRUE(std::filesystem::exists(folder / "map.ply"));
  EXPECT_TRUE(std::filesystem::exists(folder / "map.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "keyframes.simplemap"));
  EXPECT_THAT(summary.error, HasSubstr("without keyframes.simplemap: "));
}
}  // namespace
}  // namespace scanloom::slam_run_unittest
