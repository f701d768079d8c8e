#include "slam/LidarInertialSlam.h"

#include "preprocessing/Deskew.h"

#include <algorithm>

namespace scanloom
{
namespace
{
// Enough for a velocity, few enough that it is still that of the first scan.
constexpr std::size_t kScansOfFirstPass = 4;
}  // namespace

LidarInertialSlam::LidarInertialSlam(const SlamSettings& settings, const Rigid& body_T_imu)
  : settings_(settings),
    body_T_imu_(body_T_imu),
    imu_T_body_(body_T_imu.inverse()),
    local_map_(settings.local_map, settings.map_cells)
{
}

void LidarInertialSlam::addImu(const ImuSample& sample)
{
  if (!imu_.add(sample)) ++refused_imu_samples_;
}

std::vector<StateEstimate> LidarInertialSlam::addScan(Scan scan)
{
  const bool wanted = scans_seen_++ % static_cast<std::uint64_t>(settings_.slam.every_nth) == 0;
  if (wanted)
    waiting_.push_back(std::move(scan));
  else
    ++skipped_scans_;
  return processWaiting(false);
}

std::vector<StateEstimate> LidarInertialSlam::finish() { return processWaiting(true); }

std::vector<StateEstimate> LidarInertialSlam::processWaiting(bool input_ended)
{
  std::vector<StateEstimate> estimates;
  if (!smoother_ && !start(input_ended)) return estimates;
  while (!waiting_.empty() && (input_ended || covered(waiting_.front())))
  {
    estimates.push_back(track(std::move(waiting_.front())));
    waiting_.pop_front();
  }
  return estimates;
}

bool LidarInertialSlam::covered(const Scan& scan) const
{
  const Duration wait = fromSeconds(1e-3 * settings_.slam.imu_wait_ms);
  const Timestamp newest_scan_end = waiting_.back().end();
  return imu_.covers(scan.start, scan.end()) || newest_scan_end >= scan.end() + wait;
}

/** At rest if the first seconds allow it; otherwise gravity from whatever the accelerometer says. */
bool LidarInertialSlam::start(bool input_ended)
{
  if (waiting_.empty() || imu_.empty()) return false;
  const Timestamp first = waiting_.front().start;
  const Timestamp enough = first + fromSeconds(settings_.start.duration);
  if (!input_ended && !imu_.covers(first, enough)) return false;

  const Timestamp to = std::min(enough, std::max(imu_.samples().back().stamp, waiting_.front().end()));
  const std::vector<ImuSample> samples = imu_.between(first, to);
  std::optional<ImuInitialisation> initial = initialiseAtRest(samples, body_T_imu_, settings_.start);
  if (!initial)
  {
    initial = gravityOnly(samples, body_T_imu_, settings_.start);
    initial->state.stamp = first;
    initial->state.velocity = velocityOfFirstScans(*initial);
    initialising_until_ = enough;
  }
  initial->state.stamp = first;
  begin(*initial);
  return true;
}

void LidarInertialSlam::begin(const ImuInitialisation& initial)
{
  last_trusted_ = initial.state.stamp;
  smoother_.emplace(initial.state, initial.covariance, body_T_imu_, settings_.imu, settings_.smoother);
}

/** A first pass over the first scans, as if from rest: what it finds between them is the velocity to start with. */
Eigen::Vector3d LidarInertialSlam::velocityOfFirstScans(const ImuInitialisation& at_rest) const
{
  const std::size_t scans = std::min({waiting_.size(), kScansOfFirstPass, std::size_t(settings_.smoother.window - 1)});
  LidarInertialSlam trial(settings_, body_T_imu_);
  trial.imu_ = imu_;
  trial.begin(at_rest);
  for (std::size_t i = 0; i < scans; ++i) trial.track(waiting_[i]);
  return trial.smoother_->states().front().velocity;  // the window still holds the first state
}

StateEstimate LidarInertialSlam::track(Scan scan)
{
  StateEstimate estimate;
  estimate.stamp = scan.end();
  estimate.scan_complete = scan.complete();

  const NavState before = smoother_->newest();
  estimate.imu_complete = imu_.covers(before.stamp, scan.end());
  const std::vector<ImuSample> samples = imu_.between(before.stamp, scan.end());
  smoother_->addState(
      times_.measure("preintegration", [&] { return preintegrate(samples, before.bias, settings_.imu); }));
  const NavState predicted = smoother_->newest();

  const PointCloud cloud =
      times_.measure("preprocessing", [&] { return preprocess(std::move(scan), before, samples); });
  estimate.points = cloud.size();
  estimate.registration = registerToMap(cloud, bodyAt(predicted));
  if (estimate.registration && estimate.registration->outcome != Outcome::LowOverlap)
    smoother_->addPosePrior(estimate.registration->target_T_source, estimate.registration->information);
  const NavState state = times_.measure("smoother", [&] { return smoother_->optimise(); });

  estimate.map_T_body = bodyAt(state);
  estimate.velocity = state.velocity;
  estimate.health = healthOf(estimate);
  estimate.since_last = posesBetween(before, state, samples);
  const bool placed =
      local_map_.empty() || (estimate.registration && estimate.registration->outcome != Outcome::LowOverlap);
  if (placed && estimate.health != Health::Lost && local_map_.wants(estimate.map_T_body)) addKeyframe(cloud, estimate);
  imu_.forgetBefore(state.stamp);
  return estimate;
}

/** Cropped, and moved to where the body is at the end of the scan. */
PointCloud LidarInertialSlam::preprocess(Scan scan, const NavState& before, const std::vector<ImuSample>& samples) const
{
  std::vector<Timestamp> stamps;
  for (const Column& column : scan.columns) stamps.push_back(std::max(column.stamp, before.stamp));
  stamps.push_back(scan.end());
  const std::vector<NavState> states = predictAt(before, samples, stamps);

  const Rigid end_T_map = bodyAt(states.back()).inverse();
  std::vector<Rigid> end_T_column;
  for (std::size_t i = 0; i < scan.columns.size(); ++i) end_T_column.push_back(end_T_map * bodyAt(states[i]));
  return deskew(cropOut(std::move(scan), settings_.crop), end_T_column);
}

/** Roughly from the prediction, then finely from there. */
std::optional<RegistrationResult> LidarInertialSlam::registerToMap(const PointCloud& cloud, const Rigid& predicted)
{
  if (local_map_.empty() || cloud.empty()) return std::nullopt;
  const NdtMap coarse = times_.measure("scan_ndt", [&] { return NdtMap(cloud, settings_.scan_cells); });
  RegistrationResult result =
      times_.measure("rough_alignment", [&] { return align(local_map_.ndt(), coarse, predicted, settings_.rough); });
  if (!settings_.slam.refine) return result;

  const Rigid guess = result.trustworthy() ? result.target_T_source : predicted;
  const NdtMap fine = times_.measure("scan_ndt", [&] { return NdtMap(cloud, settings_.fine_cells); });
  return times_.measure("fine_alignment", [&] { return align(local_map_.ndt(), fine, guess, settings_.fine); });
}

/** Aligned again with finer cells, then added to the local map. */
void LidarInertialSlam::addKeyframe(const PointCloud& cloud, StateEstimate& estimate)
{
  if (cloud.empty()) return;
  times_.measure("keyframe",
                 [&]
                 {
                   Rigid map_T_body = estimate.map_T_body;
                   if (!local_map_.empty())
                   {
                     const NdtMap source(cloud, settings_.keyframe_cells);
                     const RegistrationResult fine = align(local_map_.ndt(), source, map_T_body, settings_.fine);
                     if (fine.trustworthy()) map_T_body = fine.target_T_source;
                   }
                   local_map_.add(cloud, map_T_body);
                   estimate.keyframe = Keyframe{estimate.stamp, map_T_body, cloud};
                 });
}

Health LidarInertialSlam::healthOf(const StateEstimate& estimate)
{
  const bool opens_the_map = local_map_.empty() && estimate.points > 0;
  const bool trusted = opens_the_map || (estimate.registration && estimate.registration->trustworthy());
  if (trusted) last_trusted_ = estimate.stamp;
  if (estimate.stamp - last_trusted_ > fromSeconds(settings_.slam.lost_after)) return Health::Lost;
  if (initialising_until_ && estimate.stamp <= *initialising_until_) return Health::Initialising;
  return trusted ? Health::Ok : Health::Degenerate;
}

/** The smoother's two states joined by the IMU; what does not close is spread over the time between. */
Trajectory LidarInertialSlam::posesBetween(const NavState& from, const NavState& to,
                                           const std::vector<ImuSample>& samples) const
{
  std::vector<Timestamp> stamps;
  for (const ImuSample& sample : samples)
    if (sample.stamp > from.stamp) stamps.push_back(sample.stamp);
  const std::vector<NavState> states = predictAt(from, samples, stamps);
  if (states.empty()) return {};

  const Vector6d gap = boxMinus(bodyAt(to), bodyAt(states.back()));
  Trajectory poses;
  for (const NavState& state : states)
  {
    const double share = seconds(state.stamp - from.stamp) / seconds(to.stamp - from.stamp);
    poses.push_back({state.stamp, boxPlus(bodyAt(state), share * gap)});
  }
  return poses;
}

Rigid LidarInertialSlam::bodyAt(const NavState& state) const { return state.map_T_imu * imu_T_body_; }
}  // namespace scanloom
