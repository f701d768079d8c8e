// The whole line with a body's IMU that fails: scans go on, every pose is one, and health says what is left of it.
#include <gtest/gtest.h>

#include "base/formats/TrajectoryReader.h"
#include "run/run/SlamFiles.h"
#include "run/run/SlamRun.h"
#include "support/SceneInput.h"
#include "support/TemporaryFolder.h"
#include "support/harvesterSettings.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <sstream>

namespace scanloom::faulty_imu_unittest
{
namespace
{
constexpr Duration kGone = 7s, kBack = 12s;  // after the start; the machine drives from 2.5 to 13.5 s

/** A drive of 16 s, simulated once. */
struct SmallDrive
{
  SmallDrive()
  {
    SimulationSettings settings;
    settings.drive.duration = 16;
    settings.lidars[0].model = "OS0-16";
    settings.lidars[0].mode = "512x10";
    scene = std::make_shared<const Scene>(makeScene(settings, 3));
    const Rig rig = rigOf(*scene, {});
    const auto input = makeSceneInput(scene, rig);
    setup = input->setup();
    while (auto event = input->next({})) events.push_back(std::move(*event));
  }

  Duration since(Timestamp stamp) const { return stamp - scene->span.start; }
  Rigid bodyAt(Timestamp stamp) const { return scene->scenery.drive().at(seconds(since(stamp))).world_T_body; }

  std::shared_ptr<const Scene> scene;
  SensorSetup setup;
  std::vector<SensorEvent> events;
};

const SmallDrive& smallDrive()
{
  static const SmallDrive drive;
  return drive;
}

/** What is left of a sample of the first IMU; nothing where it never comes. */
using Fault = std::function<std::optional<ImuSample>(ImuSample, Duration since_start)>;

class FaultyInput : public SensorInput
{
 public:
  /** Whoever has these IMUs; the first one is at fault. */
  FaultyInput(const Fault& fault, const std::vector<int>& imus) : fault_(fault), imus_(imus) {}

  std::optional<SensorEvent> next(Duration) override
  {
    const SmallDrive& drive = smallDrive();
    while (next_ < drive.events.size())
    {
      const SensorEvent& event = drive.events[next_++];
      const auto* imu = std::get_if<SensorImu>(&event);
      if (!imu || imu->sensor != imus_.front()) return event;
      if (const auto left = fault_(imu->sample, drive.since(imu->sample.stamp))) return SensorImu{imu->sensor, *left};
    }
    return std::nullopt;
  }
  bool ended() const override { return next_ == smallDrive().events.size(); }
  void stop() override {}
  SensorSetup setup() const override
  {
    SensorSetup setup{smallDrive().setup.header, {}};
    for (const int imu : imus_) setup.body_T_imu[imu] = smallDrive().setup.body_T_imu.at(imu);
    return setup;
  }

 private:
  Fault fault_;
  std::vector<int> imus_;
  std::size_t next_ = 0;
};

struct Pose
{
  StampedPose pose;
  std::string health;
  double error;     // m, agreed at the first pose
  double tilt_deg;  // between the estimate's vertical and the true one
};

double tiltBetween(const Rigid& estimate, const Rigid& truth)
{
  const Eigen::Vector3d up(0, 0, 1);
  const Eigen::Vector3d seen = estimate.rotation.conjugate() * up, there = truth.rotation.conjugate() * up;
  return std::acos(std::min(1.0, seen.dot(there))) * 180 / M_PI;
}

struct LeftBehind
{
  std::vector<Pose> poses;
  nlohmann::json summary;
  std::string csv;
  std::string warnings;
  bool passed;

  std::uint64_t count(const char* name) const { return summary.at("counts").at(name).get<std::uint64_t>(); }
  double largestErrorWhile(const std::string& health) const
  {
    double largest = 0;
    for (const Pose& p : poses)
      if (p.health == health) largest = std::max(largest, p.error);
    return largest;
  }
};

std::vector<std::string> healthsOf(const std::string& csv)
{
  std::istringstream lines(csv);
  std::vector<std::string> healths;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line))
  {
    const std::size_t from = line.find(',') + 1;
    healths.push_back(line.substr(from, line.find(',', from) - from));
  }
  return healths;
}

/** Reads back what slam leaves: readTum() refuses what is no pose. */
LeftBehind localise(const Fault& fault, const std::vector<int>& imus = {SensorImu::kBody})
{
  const TemporaryFolder folder;
  FaultyInput input(fault, imus);
  SlamFiles files(folder.path(), input.setup().header.lidars, OutputOptions{false, "", 0});
  LeftBehind outcome;
  const SlamRunResult result = runSlam(
      input, harvesterSettings(), [&](const StateEstimate& estimate) { files.add(estimate); },
      [](const RunProgress&) { return true; }, [&](const std::string& warning) { outcome.warnings += warning + '\n'; });
  files.close(result.summary);

  outcome.passed = result.passed;
  outcome.csv = contentOf(folder / "trajectory.csv");
  outcome.summary = nlohmann::json::parse(contentOf(folder / "summary.json"));
  const Trajectory trajectory = readTum(folder / "trajectory.tum");
  readTum(folder / "trajectory_imu.tum");
  const std::vector<std::string> healths = healthsOf(outcome.csv);
  EXPECT_EQ(healths.size(), trajectory.size());
  const Rigid world_T_map = smallDrive().bodyAt(trajectory.front().stamp) * trajectory.front().map_T_body.inverse();
  for (std::size_t i = 0; i < std::min(healths.size(), trajectory.size()); ++i)
  {
    const Eigen::Vector3d at = world_T_map * trajectory[i].map_T_body.translation;
    const Rigid truth = smallDrive().bodyAt(trajectory[i].stamp);
    outcome.poses.push_back(
        {trajectory[i], healths[i], (at - truth.translation).norm(), tiltBetween(trajectory[i].map_T_body, truth)});
  }
  EXPECT_EQ(outcome.csv.find("nan"), std::string::npos);
  EXPECT_EQ(outcome.count("poses") + outcome.count("scans_skipped"), outcome.count("scans"));
  EXPECT_EQ(outcome.count("poses"), trajectory.size());
  return outcome;
}

std::uint64_t posesWithin(const LeftBehind& outcome, Duration from, Duration to)
{
  std::uint64_t poses = 0;
  for (const Pose& p : outcome.poses)
  {
    const Duration at = smallDrive().since(p.pose.stamp);
    poses += at > from && at <= to;
  }
  return poses;
}
}  // namespace

TEST(FaultyImu, oneThatWorksIsTheMeasureOfTheOthers)
{
  const LeftBehind outcome = localise([](const ImuSample& sample, Duration) { return sample; });
  EXPECT_EQ(outcome.summary.at("outcome"), "OK");
  EXPECT_EQ(outcome.count("imu_samples_refused"), 0u);
  EXPECT_LE(outcome.count("scans_without_full_imu"), 1u);  // the last one ends with the input
  EXPECT_LT(outcome.largestErrorWhile("OK"), 0.1);
}

TEST(FaultyImu, silentForGoodTheLidarCarriesOnAndEveryScanWithoutImuIsCounted)
{
  constexpr Duration kEnds = 12500ms;
  Timestamp last;
  const LeftBehind silent = localise(
      [&](const ImuSample& sample, Duration at) -> std::optional<ImuSample>
      {
        if (at >= kEnds) return std::nullopt;
        last = sample.stamp;
        return sample;
      });
  EXPECT_EQ(silent.count("scans_without_full_imu"), posesWithin(silent, smallDrive().since(last), 1h));
  EXPECT_EQ(silent.count("imu_samples_refused"), 0u);
  EXPECT_LT(silent.largestErrorWhile("OK"), 0.5);

  // Nothing but NaN is as good as silence.
  std::uint64_t spoilt = 0;
  const LeftBehind nan = localise(
      [&](ImuSample sample, Duration at)
      {
        if (at < kEnds) return sample;
        ++spoilt;
        sample.gyro.setConstant(std::numeric_limits<double>::quiet_NaN());
        return sample;
      });
  EXPECT_EQ(nan.count("imu_samples_refused"), spoilt);
  EXPECT_GT(spoilt, 600u);
  EXPECT_EQ(nan.csv, silent.csv);
}

TEST(FaultyImu, silentForFiveSecondsTheLidarCarriesOnAndEveryScanHasAPose)
{
  Timestamp last, first_again = Timestamp::max();
  const LeftBehind outcome = localise(
      [&](const ImuSample& sample, Duration at) -> std::optional<ImuSample>
      {
        if (at >= kGone && at < kBack) return std::nullopt;
        if (at < kGone) last = sample.stamp;
        if (at >= kBack) first_again = std::min(first_again, sample.stamp);
        return sample;
      });
  EXPECT_EQ(outcome.count("imu_samples_refused"), 0u);
  // The last scan of the silence waits until the IMU is back, the last of all ends with the input.
  const std::uint64_t silent = posesWithin(outcome, smallDrive().since(last), smallDrive().since(first_again));
  EXPECT_GE(outcome.count("scans_without_full_imu"), silent - 1);
  EXPECT_LE(outcome.count("scans_without_full_imu"), silent + 1);
  EXPECT_LT(outcome.largestErrorWhile("OK"), 0.5);
}

TEST(FaultyImu, whatIsNotFiniteIsRefusedAndCounted)
{
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinite = std::numeric_limits<double>::infinity();
  std::uint64_t number = 0, spoilt = 0;
  const LeftBehind outcome = localise(
      [&](ImuSample sample, Duration)
      {
        if (++number % 10 != 0) return sample;
        ++spoilt;
        if (number % 20 == 0)
          sample.gyro.y() = kNan;
        else
          sample.accel.z() = kInfinite;
        return sample;
      });
  EXPECT_EQ(outcome.count("imu_samples_refused"), spoilt);
  EXPECT_EQ(outcome.summary.at("outcome"), "OK");
  EXPECT_EQ(outcome.summary.dump().find("null"), std::string::npos);
  EXPECT_LT(outcome.largestErrorWhile("OK"), 0.1);
}

TEST(FaultyImu, stampsThatGoBackAreRefusedAndCounted)
{
  std::uint64_t late = 0;
  const LeftBehind outcome = localise(
      [&](ImuSample sample, Duration at)
      {
        const bool gone_back = at >= kGone && at < kGone + 200ms;
        late += gone_back;
        if (gone_back) sample.stamp -= 1s;
        return sample;
      });
  EXPECT_EQ(late, 40u);
  EXPECT_EQ(outcome.count("imu_samples_refused"), late);
  EXPECT_EQ(outcome.poses.back().health, "OK");
  EXPECT_LT(outcome.poses.back().error, 0.15);
}

TEST(FaultyImu, aClockThatGoesBackForGoodIsRefusedUntilItHasCaughtUp)
{
  constexpr Duration kStep = 1s;
  Timestamp newest = Timestamp::min();
  std::uint64_t behind = 0;
  const LeftBehind outcome = localise(
      [&](ImuSample sample, Duration at)
      {
        if (at >= kGone) sample.stamp -= kStep;
        behind += sample.stamp <= newest;
        newest = std::max(newest, sample.stamp);
        return sample;
      });
  EXPECT_EQ(outcome.count("imu_samples_refused"), behind);
  // Those of the step, and each after it: none is covered in time. One is that of the step itself.
  EXPECT_GE(outcome.count("scans_without_full_imu"), posesWithin(outcome, kGone, 1h));
  EXPECT_LT(outcome.largestErrorWhile("OK"), 0.5);
}

TEST(FaultyImu, silentForGoodAnotherOneGoesOnAsIfNothingWereMissing)
{
  const auto ends = [](const ImuSample& sample, Duration at)
  { return at < kGone ? std::optional(sample) : std::nullopt; };
  for (const auto& imus : {std::vector<int>{SensorImu::kBody, 0, 1}, std::vector<int>{0, 1}})
  {
    const LeftBehind outcome = localise(ends, imus);
    EXPECT_EQ(outcome.count("imu_changes"), 1u) << imus.size();
    EXPECT_LE(outcome.count("scans_without_full_imu"), 2u) << imus.size();
    EXPECT_EQ(outcome.summary.at("outcome"), "OK") << imus.size();
    EXPECT_LT(outcome.largestErrorWhile("OK"), 0.15) << imus.size();
  }
}

namespace
{
const std::vector<int> kBodyAlone{SensorImu::kBody}, kAll{SensorImu::kBody, 0, 1};

bool isWithin(Duration at, Duration from, Duration length) { return at >= from && at < from + length; }

/** Adds this specific force for so long, along the IMU's x axis. */
Fault push(double force, Duration length)
{
  return [=](ImuSample sample, Duration at)
  {
    if (isWithin(at, kGone, length)) sample.accel.x() += force;
    return sample;
  };
}

std::uint64_t samplesWithin(Duration from, Duration length)
{
  std::uint64_t samples = 0;
  for (const SensorEvent& event : smallDrive().events)
    if (const auto* imu = std::get_if<SensorImu>(&event); imu && imu->sensor == SensorImu::kBody)
      samples += isWithin(smallDrive().since(imu->sample.stamp), from, length);
  return samples;
}
}  // namespace

TEST(FaultyImu, oneReadingOf200IsRefusedAndNothingIsOff)
{
  const LeftBehind outcome = localise(push(200, 5ms));
  EXPECT_EQ(outcome.count("imu_samples_refused"), 1u);
  EXPECT_EQ(outcome.summary.at("outcome"), "OK");
  EXPECT_LT(outcome.largestErrorWhile("OK"), 0.1);
  EXPECT_NE(outcome.warnings.find("the IMU 'body': samples were refused: 1 beyond its range"), std::string::npos)
      << outcome.warnings;
}

TEST(FaultyImu, aPushThatNoNeighbourKnowsIsRefusedAndNothingIsOff)
{
  const LeftBehind outcome = localise(push(20, 20ms));
  EXPECT_EQ(outcome.count("imu_samples_refused"), samplesWithin(kGone, 20ms));
  EXPECT_EQ(outcome.summary.at("outcome"), "OK");
  EXPECT_LT(outcome.largestErrorWhile("OK"), 0.1);
}

TEST(FaultyImu, aTurnRateThatNoSensorMeasuresIsRefusedAndNothingIsOff)
{
  const LeftBehind outcome = localise(
      [](ImuSample sample, Duration at)
      {
        if (isWithin(at, kGone, 5ms)) sample.gyro.z() = 1e6;
        return sample;
      });
  EXPECT_EQ(outcome.count("imu_samples_refused"), 1u);
  EXPECT_EQ(outcome.summary.at("outcome"), "OK");
  EXPECT_LT(outcome.largestErrorWhile("OK"), 0.1);
}

TEST(FaultyImu, vibrationAndShocksOfAHarvesterAreReadings)
{
  const LeftBehind outcome = localise(
      [](ImuSample sample, Duration at)
      {
        const double t = seconds(at), since_shock = std::fmod(t, 3.1);
        sample.accel.z() += 0.6 * 9.8 * std::sin(2 * M_PI * 47 * t);
        if (t > 4 && since_shock < 0.02) sample.accel.y() += 1.5 * 9.8 * std::sin(2 * M_PI * since_shock / 0.02);
        return sample;
      });
  EXPECT_EQ(outcome.count("imu_samples_refused"), 0u);
}

TEST(FaultyImu, constantReadingsAreSilence)
{
  for (const auto& imus : {kBodyAlone, kAll})
  {
    std::optional<ImuSample> first;
    const auto isFrozen = [](Duration at) { return isWithin(at, kGone, kBack - kGone); };
    const LeftBehind frozen = localise(
        [&](ImuSample sample, Duration at)
        {
          if (!isFrozen(at)) return sample;
          if (!first) first = sample;
          return ImuSample{sample.stamp, first->gyro, first->accel};
        },
        imus);
    const LeftBehind silent =
        localise([&](const ImuSample& sample, Duration at)
                 { return isFrozen(at) && sample.stamp > first->stamp ? std::nullopt : std::optional(sample); },
                 imus);
    EXPECT_EQ(frozen.csv, silent.csv) << imus.size();
    EXPECT_EQ(frozen.count("imu_changes"), silent.count("imu_changes")) << imus.size();
    EXPECT_EQ(frozen.count("imu_samples_refused"), samplesWithin(kGone, kBack - kGone) - 1) << imus.size();
  }
}

TEST(FaultyImu, missingAtTheStartTheBodysIsUsedWhenItIsThereAndItsAttitudeHolds)
{
  constexpr Duration kComes = 3s;
  const LeftBehind outcome = localise(
      [&](const ImuSample& sample, Duration at) { return at < kComes ? std::nullopt : std::optional(sample); }, kAll);
  EXPECT_EQ(outcome.count("imu_changes"), 2u);
  EXPECT_NE(outcome.warnings.find("the IMU 'body' is there again: it goes on in place of"), std::string::npos)
      << outcome.warnings;
  EXPECT_EQ(outcome.summary.at("outcome"), "OK");
  EXPECT_LT(outcome.poses.back().tilt_deg, 0.35);  // that of the body's: 0.05 m/s2 over gravity
  EXPECT_LT(outcome.largestErrorWhile("OK"), 0.5);
}

TEST(FaultyImu, aPushAsHardAsAShockMayLeaveNothingOffThatIsOk)
{
  for (const double force : {8.0, 12.0, 15.0})
    for (const Duration length : std::initializer_list<Duration>{20ms, 40ms, 200ms})
    {
      const LeftBehind outcome = localise(push(force, length));
      EXPECT_LT(outcome.largestErrorWhile("OK"), 0.35) << force << " m/s2 for " << seconds(length) << " s";
    }
}

TEST(FaultyImu, silentWithoutAnotherOneNoPoseIsOk)
{
  const LeftBehind outcome = localise([](const ImuSample& sample, Duration at)
                                      { return at >= kGone && at < kBack ? std::nullopt : std::optional(sample); });
  for (const Pose& p : outcome.poses)
  {
    const Duration at = smallDrive().since(p.pose.stamp);
    EXPECT_FALSE(at > kGone + 300ms && at < kBack && p.health == "OK") << seconds(at);
  }
  EXPECT_LT(outcome.largestErrorWhile("OK"), 0.15);
}
}  // namespace scanloom::faulty_imu_unittest
