#include "run/run/SlamRun.h"

#include "estimation/slam/ConstantMotion.h"
#include "input/rig/silentLidars.h"
#include "run/run/ImuInUse.h"
#include "run/run/internal/CropReport.h"
#include "run/run/internal/MapInUse.h"
#include "run/run/internal/RunCounts.h"
#include "run/run/internal/reasonOf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

namespace scanloom
{
namespace
{
using SteadyClock = std::chrono::steady_clock;

double secondsSince(SteadyClock::time_point start)
{
  return std::chrono::duration<double>(SteadyClock::now() - start).count();
}

/** From the first stamp to the last, in any order. */
struct TimesSeen
{
  Timestamp first = Timestamp::max(), last = Timestamp::min();

  void add(Timestamp stamp)
  {
    first = std::min(first, stamp);
    last = std::max(last, stamp);
  }
};

/** What is wrong with an IMU none of whose samples is of the scans' time; empty if nothing is. */
std::string otherClock(const TimesSeen& imu, const TimesSeen& scans)
{
  constexpr double kTaiAheadOfUtc = 37, kLeast = 1, kFarthestOffset = 1e6;  // s
  const double later = seconds(imu.first - scans.last), earlier = seconds(scans.first - imu.last);
  if (scans.first > scans.last || std::max(later, earlier) < kLeast) return "";
  const double begins = seconds(imu.first - scans.first);
  const bool is_leap_seconds = std::abs(std::abs(begins) - kTaiAheadOfUtc) < 5;
  const double offset = is_leap_seconds ? std::copysign(kTaiAheadOfUtc, begins) : begins;
  std::string advice = fmt::format(
      "is not used, its clock is another one: its samples begin {:.1f} s {} the scans{}. Stamp both by one clock",
      std::abs(begins), begins > 0 ? "after" : "before", is_leap_seconds ? " (37 s are between TAI and UTC)" : "");
  if (std::abs(offset) < kFarthestOffset)
    advice +=
        fmt::format(", or set time_offset = {}{:.1f} (s) for each lidar", is_leap_seconds ? "" : "about ", offset);
  return advice;
}

std::map<int, RigImu> imusOf(const SensorSetup& setup)
{
  std::map<int, RigImu> imus;
  for (const auto& [sensor, body_T_imu] : setup.body_T_imu)
    if (sensor == SensorImu::kBody)
      imus[sensor] = {"the IMU", body_T_imu, body_T_imu};
    else
      imus[sensor] = {fmt::format("the IMU of the lidar '{}'", imuName(setup, sensor)), body_T_imu,
                      setup.header.lidars.at(static_cast<std::size_t>(sensor)).body_T_sensor};
  return imus;
}

/** Two registrations in a row give a turn without the IMU. A keyframe of the start still drifts. */
LocalisedScan localised(const StateEstimate& estimate)
{
  LocalisedScan scan{estimate.stamp, std::nullopt, nullptr};
  if (estimate.registration && estimate.registration->outcome == Outcome::Converged && !estimate.recovered)
    scan.registered = estimate.registration->target_T_source;
  if (estimate.keyframe && estimate.health != Health::Initialising) scan.keyframe = &*estimate.keyframe;
  return scan;
}

/** One run, event by event. */
class SlamRun
{
 public:
  SlamRun(SensorInput& input, const SlamSettings& settings, const SeeEstimate& see, const Warn& warn,
          const SeeMark& see_mark, const GivenMap& given)
    : input_(input),
      see_(see),
      warn_(warn),
      see_mark_(see_mark),
      settings_(settings),
      imu_(chosenImu(input, settings.slam.imu, fromSeconds(1e-3 * settings.slam.imu_delay_ms))),
      slam_(settingsInUse(), imuPose(), mountedLidars(lidars())),
      check_(mountedLidars(lidars()), imusOf(input.setup()), imu_ ? std::optional(imu_->sensor()) : std::nullopt, warn),
      map_(given, settings, mountedLidars(lidars()))
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
    if (const auto* mark = std::get_if<EventMark>(&*event)) take(*mark);
  }

  void finish()
  {
    if (mayGoWithoutImu()) goOnWithoutImu();
    keep(slam_.finish());
    if (map_.isSearched()) warn_(map_.whyNotFound());
    times_.measure("rig_check", [&] { check_.finish(); });
    for (const auto& [name, refused] : refusedReadings())
      warn_(fmt::format("the IMU '{}': samples were refused: {}", name, refused.toString()));
    for (const std::string& warning : cropWarnings(slam_.cropped(), lidars())) warn_(warning);
    for (const std::string& line : silentLidars(input_.account())) warn_(line);
    if (counts_.map_jumps > 0) warn_(jumpsOfMap());
    for (const auto& [sensor, imu] : times_of_imus_)
      if (const std::string clock = otherClock(imu, times_of_scans_); !clock.empty())
      {
        warn_(fmt::format("the IMU '{}' {}", imuName(input_.setup(), sensor), clock));
        imu_of_other_clock_ = true;
      }
  }

  RunProgress progress() const
  {
    const double waited = 1e-3 * times_.stages().at("input").total_ms;
    return {input_.progress(), counts_.scans, counts_.recorded(), secondsSince(start_) - waited, map_.foundAfter()};
  }

  bool hasBegun() const { return counts_.scans > 0; }

  SlamRunResult failed(const std::exception& error) const
  {
    SlamRunResult result = this->result(false);
    result.passed = false;
    result.summary.outcome = "FAILED";
    result.summary.error = reasonOf(error);
    return result;
  }

  SlamRunResult result(bool interrupted) const
  {
    SlamRunResult result;
    RunSummary& summary = result.summary;
    const bool whole = slam_.mapRestarts() == 0;
    const RigAccount account = input_.account();
    const bool silent = !silentLidars(account).empty();
    result.passed =
        counts_.passed() && whole && !silent && !check_.warned() && !imu_of_other_clock_ && !map_.isSearched();
    result.with_imu = imu_.has_value();
    summary.imu = check_.imu();
    summary.lidars = check_.lidars();
    summary.outcome = interrupted ? "INTERRUPTED" : whole ? counts_.outcome() : "LOST";
    if (silent && summary.outcome == "OK") summary.outcome = "LIDAR MISSING";
    if (imu_of_other_clock_ && summary.outcome == "OK") summary.outcome = "IMU MISSING";
    if (check_.warned() && summary.outcome == "OK") summary.outcome = "RIG NOT FIT";
    if (map_.isSearched() && counts_.passed() && whole && !interrupted) summary.outcome = "NOT IN MAP";
    summary.counts = countsOf(account);
    summary.counts["scans_skipped"] = slam_.skippedScans();
    summary.counts["recoveries"] = slam_.recoveries();
    summary.counts["map_restarts"] = slam_.mapRestarts();
    summary.counts["imu_samples_refused"] = 0;
    for (const auto& [name, refused] : refusedReadings()) summary.counts["imu_samples_refused"] += refused.sum();
    counts_.addTo(summary.counts);
    addCounts(slam_.cropped(), lidars(), summary.counts);
    summary.stages = slam_.times().stages();
    for (const auto& [stage, time] : times_.stages()) summary.stages[stage] = time;
    for (const auto& [stage, time] : input_.stages()) summary.stages[stage] = time;
    summary.marks = marks_;
    summary.recorded = counts_.recorded();
    summary.elapsed = secondsSince(start_);
    return result;
  }

 private:
  std::vector<RecordedLidar> lidars() const { return input_.setup().header.lidars; }

  Rigid imuPose() const { return imu_ ? imu_->body_T_imu() : Rigid::identity(); }

  const ImuNoise& noise() const
  {
    if (!imu_) return settings_.no_imu;
    return imu_->insideLidar() ? settings_.lidar_imu : settings_.imu;
  }

  std::map<std::string, RefusedReadings> refusedReadings() const
  {
    return imu_ ? imu_->refused() : std::map<std::string, RefusedReadings>{};
  }

  SlamSettings settingsInUse() const
  {
    SlamSettings in_use = settings_;
    in_use.imu = noise();
    if (imu_) in_use.slam.imu_wait_ms = 1e3 * seconds(imu_->patience(fromSeconds(1e-3 * settings_.slam.imu_wait_ms)));
    return in_use;
  }

  void take(const SensorImu& read)
  {
    times_of_imus_[read.sensor].add(read.sample.stamp);
    if (motion_ || !imu_) return;
    imu_received_ = true;
    uncovered_.clear();
    if (read.sensor != imu_->sensor()) check_.add(read.sensor, read.sample);
    for (const ImuSample& sample : imu_->take(read))
    {
      check_.add(read.sensor, sample);
      slam_.addImu(sample);
      keep(slam_.process());
    }
  }

  void take(Scan scan)
  {
    constexpr Duration kImuSendsWithin = 1s;  // every IMU sends far more often
    ++counts_.scans;
    times_of_scans_.add(scan.start);
    times_of_scans_.add(scan.end());
    if (!first_scan_) first_scan_ = scan.start;
    if (motion_ || mayGoWithoutImu()) uncovered_.push_back(scan.end());
    if (mayGoWithoutImu() && (!imu_ || scan.end() - *first_scan_ > kImuSendsWithin)) goOnWithoutImu();
    if (!motion_) chooseImu(scan.end());
    times_.measure("rig_check", [&] { check_.add(scan); });
    keep(slam_.addScan(std::move(scan)));
    coverScans();
  }

  void take(const EventMark& mark)
  {
    marks_.push_back({mark, first_scan_ ? seconds(mark.stamp - *first_scan_) : 0});
    see_mark_(mark);
  }

  std::string jumpsOfMap() const
  {
    return fmt::format(
        "the map was levelled anew {} times, by up to {:.1f} m at once: what the IMU measures contradicts what the "
        "lidars see",
        counts_.map_jumps, counts_.largest_shift);
  }

  bool mayGoWithoutImu() const
  {
    return !motion_ && first_scan_ && !imu_received_ && (!imu_ || settings_.slam.imu == "auto");
  }

  /** From the first scan on: none was processed so far, because that takes an IMU. */
  void goOnWithoutImu()
  {
    if (settings_.slam.imu != "none")
      warn_("there is no IMU: constant velocity and turn rate are assumed between scans, and a level start");
    imu_.reset();
    motion_.emplace(*first_scan_);
    slam_.changeImu({{Rigid::identity(), settings_.no_imu, true}, {}, {}});
    coverScans();
  }

  /** Scan by scan, because what is assumed for the next one follows from the estimate of the last one. */
  void coverScans()
  {
    for (; motion_ && !uncovered_.empty(); uncovered_.pop_front())
    {
      for (const ImuSample& assumed : motion_->samplesUntil(uncovered_.front())) slam_.addImu(assumed);
      keep(slam_.process());
    }
  }

  void chooseImu(Timestamp now)
  {
    if (imu_->changeIfShaken())
      changeImu(fmt::format("the IMU '{}' shakes more than ten times as much as '{}', which is used instead",
                            imu_->previousName(), imu_->name()));
    else if (imu_->changeIfSilent(now))
      changeImu(fmt::format("the IMU '{}' is silent: '{}' goes on", imu_->previousName(), imu_->name()));
    else if (imu_->returnToBetter(now))
      changeImu(
          fmt::format("the IMU '{}' is there again: it goes on in place of '{}'", imu_->name(), imu_->previousName()));
  }

  void changeImu(const std::string& why)
  {
    ++counts_.imu_changes;
    warn_(why);
    check_.changeImu(imu_->sensor());
    slam_.changeImu({{imuPose(), noise()}, imu_->recent(), imu_->previous()});
  }

  void keep(std::vector<StateEstimate> estimates)
  {
    for (StateEstimate& estimate : estimates)
    {
      estimate.entered_map = estimate.in_map && !was_in_map_;
      if (motion_) estimate.imu.reset();  // it was assumed
      counts_.add(estimate);
      if (motion_) motion_->update(estimate);
      times_.measure("rig_check", [&] { check(estimate); });
      see_(estimate);
    }
    std::optional<MapEntry> entry;
    times_.measure("place_search", [&] { entry = map_.add(estimates, motion_ ? LevelBy::Assumption : LevelBy::Imu); });
    if (!entry) return;
    slam_.enterMap(*entry);
    if (motion_) motion_->enterMap(entry->map_T_drive);
  }

  /** The lidars are compared over the whole drive: in the frame in which it began. */
  void check(const StateEstimate& estimate)
  {
    LocalisedScan scan = localised(estimate);
    // A step from one frame to the other is no turn.
    if (std::exchange(was_in_map_, estimate.in_map) != estimate.in_map) scan.registered.reset();
    std::optional<Keyframe> in_drive;
    if (scan.keyframe && map_.foundAfter()) in_drive = map_.inDrive(*scan.keyframe);
    if (in_drive) scan.keyframe = &*in_drive;
    check_.add(scan);
  }

  SteadyClock::time_point start_ = SteadyClock::now();
  SensorInput& input_;
  const SeeEstimate& see_;
  const Warn& warn_;
  const SeeMark& see_mark_;
  SlamSettings settings_;
  std::optional<ImuInUse> imu_;  // none: there is no IMU
  LidarInertialSlam slam_;
  std::optional<ConstantMotion> motion_;  // in place of an IMU
  std::optional<Timestamp> first_scan_;
  std::deque<Timestamp> uncovered_;  // ends of scans that an IMU, or what is assumed for it, does not cover yet
  bool imu_received_ = false;
  std::map<int, TimesSeen> times_of_imus_;  // by SensorImu::sensor
  TimesSeen times_of_scans_;
  bool imu_of_other_clock_ = false;
  std::vector<MarkedEvent> marks_;
  RigCheck check_;
  MapInUse map_;
  bool was_in_map_ = false;  // at the scan before
  StageTimes times_;
  RunCounts counts_;
};
}  // namespace

SlamRunResult runSlam(SensorInput& input, const SlamSettings& settings, const SeeEstimate& see,
                      const KeepGoing& keepGoing, const Warn& warn, const SeeMark& see_mark, const GivenMap& map)
{
  SlamRun run(input, settings, see, warn, see_mark, map);
  bool going = true;
  try
  {
    while (going && !input.ended())
    {
      run.step();
      going = keepGoing(run.progress());
    }
    run.finish();
  }
  catch (const std::exception& error)
  {
    if (!run.hasBegun()) throw;
    return run.failed(error);
  }
  return run.result(!going);
}
}  // namespace scanloom
