#include "output/SlamRun.h"

#include "output/HealthCounts.h"
#include "output/ImuInUse.h"
#include "slam/ConstantMotion.h"
#include "slam/ImuWatch.h"

#include <fmt/format.h>

#include <deque>

namespace scanloom
{
namespace
{
using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::vector<Eigen::Vector3d> positionsOf(const std::vector<RecordedLidar>& lidars)
{
  std::vector<Eigen::Vector3d> positions;
  for (const RecordedLidar& lidar : lidars) positions.push_back(lidar.body_T_sensor.translation);
  return positions;
}

/** As `<name>.points_<fate>`. */
void addCounts(const std::vector<CropCounts>& cropped, const std::vector<RecordedLidar>& lidars,
               std::map<std::string, std::uint64_t>& counts)
{
  for (std::size_t i = 0; i < cropped.size(); ++i)
    CropCounts::forEach([&](const char* name, auto fate)
                        { counts[fmt::format("{}.points_{}", lidars.at(i).name, name)] = cropped[i].*fate; });
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

  /** Another one from here on. */
  void change(const Rigid& body_T_imu) { watch_ = ImuWatch(body_T_imu); }

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

/** One run, event by event. */
class SlamRun
{
 public:
  SlamRun(SensorInput& input, const SlamSettings& settings, SlamFiles& files, const Warn& warn)
    : input_(input),
      files_(files),
      warn_(warn),
      lidars_(input.header().lidars),
      coasts_(settings.slam.constant_motion),
      imu_(input, settings.slam.imu, fromSeconds(1e-3 * settings.slam.imu_delay_ms)),
      settings_(settings),
      slam_(settingsInUse(), imu_.body_T_imu(), positionsOf(lidars_),
            lidarBoxes(settings.crop.lidar_boxes, mountedLidars(lidars_))),
      motion_(imu_.body_T_imu()),
      watch_(imu_.body_T_imu(), warn)
  {
  }

  /** Waits for an event no longer than a person who wants to stop it would. */
  void step()
  {
    constexpr Duration kPatience = 100ms;
    std::optional<SensorEvent> event = times_.measure("input", [&] { return input_.next(kPatience); });
    if (!event) return;
    if (const auto* sample = std::get_if<SensorImu>(&*event)) take(*sample);
    if (auto* scan = std::get_if<Scan>(&*event)) take(std::move(*scan));
  }

  void finish()
  {
    ended_ = true;
    release();
    keep(slam_.finish());
    watch_.look();
    warnOfTooMuch(slam_.cropped(), lidars_, warn_);
  }

  RunProgress progress() const
  {
    const double waited = 1e-3 * times_.stages().at("input").total_ms;
    return {input_.progress(), scans_, health_.recorded(), secondsSince(start_) - waited};
  }

  SlamRunResult result(bool interrupted) const
  {
    SlamRunResult result;
    RunSummary& summary = result.summary;
    const bool whole = slam_.mapRestarts() == 0;
    result.passed = health_.passed() && whole && !watch_.complained();
    summary.imu = watch_.agreement();
    summary.outcome = interrupted ? "INTERRUPTED" : whole ? health_.outcome() : "LOST";
    summary.counts = input_.counts();
    summary.counts["scans"] = scans_;
    summary.counts["scans_skipped"] = slam_.skippedScans();
    summary.counts["recoveries"] = slam_.recoveries();
    summary.counts["map_restarts"] = slam_.mapRestarts();
    summary.counts["imu_samples_refused"] = slam_.refusedImuSamples();
    summary.counts["imu_changes"] = imu_changes_;
    health_.addTo(summary.counts);
    addCounts(slam_.cropped(), lidars_, summary.counts);
    summary.stages = slam_.times().stages();
    for (const auto& [stage, time] : times_.stages()) summary.stages[stage] = time;
    for (const auto& [stage, time] : input_.stages()) summary.stages[stage] = time;
    summary.recorded = health_.recorded();
    summary.elapsed = secondsSince(start_);
    return result;
  }

 private:
  const ImuNoise& noise() const { return imu_.insideLidar() ? settings_.lidar_imu : settings_.imu; }

  SlamSettings settingsInUse() const
  {
    SlamSettings in_use = settings_;
    in_use.imu = noise();
    return in_use;
  }

  void take(const SensorImu& read)
  {
    const std::optional<ImuSample> sample = imu_.take(read);
    if (!sample) return;
    watch_.add(*sample);
    if (!motion_.known()) slam_.addImu(*sample);
    release();
  }

  void take(Scan scan)
  {
    ++scans_;
    waiting_.push_back(std::move(scan));
    release();
  }

  /** Not before it is clear which IMU a scan is to be seen with: readings that were held would bend the way there. */
  void release()
  {
    while (!waiting_.empty())
    {
      const Timestamp end = waiting_.front().end(), now = waiting_.back().end();
      if (!coasts_ && !imu_.reaches(end))
      {
        if (!ended_ && imu_.mayChange() && now - end < ImuInUse::kPatience) return;
        changeImuIfSilent(now);
      }
      for (const ImuSample& imagined : motion_.samplesUntil(end)) slam_.addImu(imagined);
      keep(slam_.addScan(std::move(waiting_.front())));
      waiting_.pop_front();
    }
  }

  void changeImuIfSilent(Timestamp now)
  {
    const std::string silent = imu_.name();
    if (!imu_.changeIfSilent(now)) return;
    ++imu_changes_;
    warn_(fmt::format("the IMU '{}' is silent: '{}' goes on", silent, imu_.name()));
    watch_.change(imu_.body_T_imu());
    slam_.changeImu({imu_.body_T_imu(), noise(), imu_.recent(), imu_.previous()});
  }

  void keep(const std::vector<StateEstimate>& estimates)
  {
    for (const StateEstimate& estimate : estimates)
    {
      health_.add(estimate);
      if (coasts_) motion_.update(estimate);
      watch_.add(estimate);
      files_.add(estimate);
    }
  }

  Clock::time_point start_ = Clock::now();
  SensorInput& input_;
  SlamFiles& files_;
  const Warn& warn_;
  const std::vector<RecordedLidar>& lidars_;
  bool coasts_;
  ImuInUse imu_;
  SlamSettings settings_;
  LidarInertialSlam slam_;
  ConstantMotion motion_;
  WatchedImu watch_;
  StageTimes times_;
  HealthCounts health_;
  std::deque<Scan> waiting_;  // for the IMU
  bool ended_ = false;
  std::uint64_t scans_ = 0, imu_changes_ = 0;
};
}  // namespace

SlamRunResult runSlam(SensorInput& input, const SlamSettings& settings, SlamFiles& files, const KeepGoing& keepGoing,
                      const Warn& warn)
{
  SlamRun run(input, settings, files, warn);
  bool going = true;
  while (going && !input.ended())
  {
    run.step();
    going = keepGoing(run.progress());
  }
  run.finish();
  return run.result(!going);
}
}  // namespace scanloom
