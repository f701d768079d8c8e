#include "output/SlamRun.h"

#include "slam/ConstantMotion.h"
#include "slam/ImuWatch.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/** The IMU that localisation listens to. */
int chooseImu(const SensorInput& input, const std::string& wanted)
{
  const auto& lidars = input.header().lidars;
  std::vector<std::string> choices;
  if (input.body_T_imu(SensorImu::kBody)) choices.emplace_back("body");
  for (const RecordedLidar& lidar : lidars) choices.push_back(lidar.name);

  const std::string& name = wanted == "auto" && !choices.empty() ? choices.front() : wanted;
  if (name == "body" && input.body_T_imu(SensorImu::kBody)) return SensorImu::kBody;
  for (std::size_t i = 0; i < lidars.size(); ++i)
    if (lidars[i].name == name && input.body_T_imu(static_cast<int>(i))) return static_cast<int>(i);
  throw ConfigError(fmt::format("[slam] imu = {}: the input has no such IMU: {}", wanted, suggestion(wanted, choices)));
}

std::vector<Eigen::Vector3d> positionsOf(const std::vector<RecordedLidar>& lidars)
{
  std::vector<Eigen::Vector3d> positions;
  for (const RecordedLidar& lidar : lidars) positions.push_back(lidar.body_T_sensor.translation);
  return positions;
}

std::vector<LidarBox> boxesOf(const CropOptions& crop, const std::vector<RecordedLidar>& lidars)
{
  std::vector<NamedPose> poses;
  for (const RecordedLidar& lidar : lidars) poses.push_back({lidar.name, lidar.body_T_sensor});
  return lidarBoxes(crop.lidar_boxes, poses);
}

/** As `<name>.points_<fate>`. */
void addCounts(const std::vector<CropCounts>& cropped, const std::vector<RecordedLidar>& lidars,
               std::map<std::string, std::uint64_t>& counts)
{
  for (std::size_t i = 0; i < cropped.size(); ++i)
    CropCounts::forEach(cropped[i], [&](const char* fate, std::uint64_t count)
                        { counts[fmt::format("{}.points_{}", lidars.at(i).name, fate)] = count; });
}

/** A box too large, or in another frame than was thought, is the first mistake that a person makes. */
void warnOfTooMuch(const std::vector<CropCounts>& cropped, const std::vector<RecordedLidar>& lidars, const Warn& warn)
{
  constexpr double kLeast = 0.1;
  for (std::size_t i = 0; i < cropped.size(); ++i)
  {
    const CropCounts& c = cropped[i];
    if (static_cast<double>(c.kept) >= kLeast * static_cast<double>(c.all())) continue;
    warn(
        fmt::format("[crop] leaves {} of {} points of lidar '{}': {} are in the machine's box, {} in its own, {} too "
                    "near, {} too far",
                    c.kept, c.all(), lidars.at(i).name, c.machine, c.lidar_box, c.too_near, c.too_far));
  }
}

/** Looks once a minute and at the end; says a thing once. */
class WatchedImu
{
 public:
  WatchedImu(const Rigid& body_T_imu, const Warn& warn) : watch_(body_T_imu), warn_(warn) {}

  void add(const ImuSample& sample) { watch_.add(sample); }

  void add(const StateEstimate& estimate)
  {
    watch_.add(estimate);
    if (!next_look_) next_look_ = estimate.stamp + kBetweenLooks;
    if (estimate.stamp < *next_look_) return;
    next_look_ = estimate.stamp + kBetweenLooks;
    look();
  }

  void look()
  {
    agreement_ = watch_.agreement();
    if (complained_) return;
    const std::optional<std::string> complaint = watch_.complaint(agreement_);
    if (!complaint) return;
    warn_("the IMU: " + *complaint);
    complained_ = true;
  }

  bool complained() const { return complained_; }

  /** As of the last look. */
  const std::optional<GyroAgreement>& agreement() const { return agreement_; }

 private:
  static constexpr Duration kBetweenLooks = 60s;

  ImuWatch watch_;
  const Warn& warn_;
  std::optional<Timestamp> next_look_;
  std::optional<GyroAgreement> agreement_;
  bool complained_ = false;
};

struct HealthCounts
{
  std::uint64_t poses = 0, initialising = 0, degenerate = 0, lost = 0, keyframes = 0;
  std::uint64_t cut_scans = 0, imu_short = 0;
  Health last = Health::Ok;
  std::optional<Timestamp> first;
  Timestamp newest;

  void add(const StateEstimate& e)
  {
    ++poses;
    initialising += e.health == Health::Initialising;
    degenerate += e.health == Health::Degenerate;
    lost += e.health == Health::Lost;
    keyframes += e.keyframe.has_value();
    cut_scans += !e.scan_complete;
    imu_short += !e.imu_complete;
    last = e.health;
    if (!first) first = e.stamp;
    newest = e.stamp;
  }

  double recorded() const { return first ? seconds(newest - *first) : 0; }
  bool passed() const { return poses > 0 && last != Health::Lost && 20 * lost <= poses; }

  std::string outcome() const
  {
    if (poses == 0) return "NOTHING";
    if (!passed()) return "LOST";
    if (last == Health::Initialising) return "INITIALISING";
    return degenerate + lost > 0 ? "DEGENERATE" : "OK";
  }
};
}  // namespace

SlamRunResult runSlam(SensorInput& input, const SlamSettings& settings, SlamFiles& files, const KeepGoing& keepGoing,
                      const Warn& warn)
{
  const Clock::time_point start = Clock::now();
  const std::vector<RecordedLidar>& lidars = input.header().lidars;
  const int imu = chooseImu(input, settings.slam.imu);
  LidarInertialSlam slam(settings, *input.body_T_imu(imu), positionsOf(lidars), boxesOf(settings.crop, lidars));
  ConstantMotion motion(*input.body_T_imu(imu));
  const bool coasts = settings.slam.constant_motion;
  const Duration delay = fromSeconds(1e-3 * settings.slam.imu_delay_ms);
  WatchedImu watch(*input.body_T_imu(imu), warn);
  StageTimes times;
  HealthCounts health;
  std::uint64_t scans = 0;
  const auto keep = [&](const std::vector<StateEstimate>& estimates)
  {
    for (const StateEstimate& estimate : estimates)
    {
      health.add(estimate);
      if (coasts) motion.update(estimate);
      watch.add(estimate);
      files.add(estimate);
    }
  };

  const auto progress = [&]
  {
    const double waited = 1e-3 * times.stages().at("input").total_ms;
    return RunProgress{input.progress(), scans, health.recorded(), secondsSince(start) - waited};
  };

  constexpr Duration kPatience = 100ms;  // live: then a person may want to stop
  bool going = true;
  while (going && !input.ended())
  {
    std::optional<SensorEvent> event = times.measure("input", [&] { return input.next(kPatience); });
    if (!event)
      going = keepGoing(progress());
    else if (auto* sample = std::get_if<SensorImu>(&*event))
    {
      if (sample->sensor != imu) continue;
      sample->sample.stamp -= delay;
      watch.add(sample->sample);
      if (!motion.known()) slam.addImu(sample->sample);
    }
    else if (auto* scan = std::get_if<Scan>(&*event))
    {
      ++scans;
      for (const ImuSample& imagined : motion.samplesUntil(scan->end())) slam.addImu(imagined);
      keep(slam.addScan(std::move(*scan)));
      going = keepGoing(progress());
    }
  }
  keep(slam.finish());

  SlamRunResult result;
  RunSummary& summary = result.summary;
  watch.look();
  result.passed = health.passed() && !watch.complained();
  summary.imu = watch.agreement();
  summary.outcome = going ? health.outcome() : "INTERRUPTED";
  summary.counts = input.counts();
  summary.counts["scans"] = scans;
  summary.counts["scans_skipped"] = slam.skippedScans();
  summary.counts["scans_cut"] = health.cut_scans;
  summary.counts["scans_without_full_imu"] = health.imu_short;
  summary.counts["poses"] = health.poses;
  summary.counts["poses_initialising"] = health.initialising;
  summary.counts["poses_degenerate"] = health.degenerate;
  summary.counts["poses_lost"] = health.lost;
  summary.counts["keyframes"] = health.keyframes;
  summary.counts["recoveries"] = slam.recoveries();
  summary.counts["map_restarts"] = slam.mapRestarts();
  summary.counts["imu_samples_refused"] = slam.refusedImuSamples();
  addCounts(slam.cropped(), lidars, summary.counts);
  warnOfTooMuch(slam.cropped(), lidars, warn);
  summary.stages = slam.times().stages();
  for (const auto& [stage, time] : times.stages()) summary.stages[stage] = time;
  for (const auto& [stage, time] : input.stages()) summary.stages[stage] = time;
  summary.recorded = health.recorded();
  summary.elapsed = secondsSince(start);
  return result;
}
}  // namespace scanloom
