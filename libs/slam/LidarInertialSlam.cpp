#include "slam/LidarInertialSlam.h"

#include "ndt/Rivals.h"
#include "preprocessing/Deskew.h"
#include "slam/ImuWatch.h"
#include "slam/PosesOnTheWay.h"
#include "slam/ScanRegistration.h"

#include <algorithm>
#include <utility>

namespace scanloom
{
namespace
{
// Enough for a velocity, few enough that it is still that of the first scan.
constexpr std::size_t kScansOfFirstPass = 4;
}  // namespace

LidarInertialSlam::LidarInertialSlam(const SlamSettings& settings, const Rigid& body_T_imu,
                                     std::vector<Eigen::Vector3d> lidars, std::vector<LidarBox> lidar_boxes)
  : settings_(settings),
    body_T_imu_(body_T_imu),
    imu_T_body_(body_T_imu.inverse()),
    lidars_(settings.slam.stem_axes ? std::move(lidars) : std::vector<Eigen::Vector3d>()),
    lidar_boxes_(std::move(lidar_boxes)),
    local_map_(settings.local_map, settings.map_cells)
{
}

void LidarInertialSlam::addImu(const ImuSample& sample)
{
  if (!imu_.add(sample)) ++refused_imu_samples_;
}

void LidarInertialSlam::changeImu(const ImuChange& change)
{
  const Rigid body_T_imu_before = std::exchange(body_T_imu_, change.body_T_imu);
  const Rigid map_T_local = smoother_ ? this->map_T_local() : Rigid::identity();
  imu_T_body_ = body_T_imu_.inverse();
  settings_.imu = change.noise;
  imu_ = ImuBuffer();
  for (const ImuSample& sample : change.samples) addImu(sample);
  if (!smoother_) return;

  const NavEstimate start = continuedBy(change, newest(), body_T_imu_before);
  const bool anchored = smoother_->hasAnchor();
  begin(start);
  if (anchored) anchorAt(map_T_local.inverse() * bodyAt(start.state));
  if (last_seen_) last_seen_->bias = start.state.bias;
}

std::vector<StateEstimate> LidarInertialSlam::addScan(Scan scan)
{
  if (isCutStart(scan))
  {
    ++skipped_scans_;
    return {};
  }
  const bool wanted = scans_seen_++ % static_cast<std::uint64_t>(settings_.slam.every_nth) == 0;
  // A whole turn that found no other in time may end before those that did: there is no way back to it.
  const bool late = last_end_ && scan.end() <= *last_end_;
  if (!wanted || late)
  {
    ++skipped_scans_;
    return processWaiting(false);
  }
  last_end_ = scan.end();
  waiting_.push_back(std::move(scan));
  return processWaiting(false);
}

/** Whole turns begin amid a turn of each lidar: a map that begins with a piece of one finds little of the next scans.
 */
bool LidarInertialSlam::isCutStart(const Scan& scan)
{
  constexpr Duration kPatience = 1s;  // then a lidar may be silent for good
  if (last_end_ || scan.complete()) return false;
  if (!first_start_) first_start_ = scan.start;
  return scan.start - *first_start_ < kPatience;
}

std::vector<StateEstimate> LidarInertialSlam::finish() { return processWaiting(true); }

std::vector<StateEstimate> LidarInertialSlam::processWaiting(bool input_ended)
{
  std::vector<StateEstimate> estimates;
  if (!smoother_ && !start(input_ended)) return estimates;
  while (!waiting_.empty() && (input_ended || covered(waiting_.front())))
  {
    estimates.push_back(times_.measure("scan", [&] { return track(std::move(waiting_.front())); }));
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
  requireGravity(samples, body_T_imu_);
  std::optional<ImuInitialisation> initial =
      initialiseAtRest(samples, body_T_imu_, settings_.start, settings_.imu.accel_bias_sigma);
  if (!initial)
  {
    initial = gravityOnly(samples, body_T_imu_, settings_.imu.accel_bias_sigma);
    initial->state.stamp = first;
    initial->state.velocity = velocityOfFirstScans(*initial);
    initialising_until_ = enough;
  }
  initial->state.stamp = first;
  last_trusted_ = first;
  begin({initial->state, initial->covariance});
  return true;
}

void LidarInertialSlam::begin(const NavEstimate& first)
{
  smoother_.emplace(first.state, first.covariance, body_T_imu_, settings_.imu, settings_.smoother);
}

/** A first pass over the first scans, as if from rest: what it finds between them is the velocity to start with. */
Eigen::Vector3d LidarInertialSlam::velocityOfFirstScans(const ImuInitialisation& at_rest) const
{
  const std::size_t scans = std::min({waiting_.size(), kScansOfFirstPass, std::size_t(settings_.smoother.window - 1)});
  LidarInertialSlam trial(settings_, body_T_imu_, lidars_);
  trial.imu_ = imu_;
  trial.last_trusted_ = at_rest.state.stamp;
  trial.begin({at_rest.state, at_rest.covariance});
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

  const Rigid predicted = bodyAt(smoother_->newest());
  PointCloud cloud = times_.measure("preprocessing", [&] { return preprocess(std::move(scan), before, samples); });
  const std::vector<View> views = times_.measure("preprocessing", [&] { return viewsOf(cloud, lidars_); });
  estimate.points = cloud.size();
  locate(views, estimate);
  const NavState state = times_.measure("smoother", [&] { return smoother_->optimise(); });

  estimate.map_T_body = bodyAt(state);
  estimate.covariance = smoother_->bodyCovarianceAfter(estimate.covariance);
  estimate.velocity = state.velocity;
  estimate.since_last = posesBetween(before, state, samples, imu_T_body_);
  estimate.health = healthOf(estimate);
  const bool blind = estimate.health == Health::Lost && !contradicts();
  if (blind && recover(views, estimate)) estimate.health = healthOf(estimate);
  estimate.correction = boxMinus(estimate.map_T_body, predicted);
  way_to_last_ = estimate.recovered ? Trajectory{} : estimate.since_last;
  updateMap(std::move(cloud), views, estimate);
  imu_.forgetBefore(state.stamp);
  return estimate;
}

/** Cropped, and moved to where the body is at the end of the scan. */
PointCloud LidarInertialSlam::preprocess(Scan scan, const NavState& before, const std::vector<ImuSample>& samples)
{
  const std::vector<Rigid> map_T_column = bodyAtColumns(scan, before, samples, imu_T_body_, way_to_last_);
  const Rigid end_T_map = bodyAt(predictAt(before, samples, {scan.end()}).front()).inverse();
  std::vector<Rigid> end_T_column;
  for (const Rigid& pose : map_T_column) end_T_column.push_back(end_T_map * pose);
  CroppedScan cropped = cropOut(std::move(scan), settings_.crop, lidar_boxes_);
  if (cropped_.size() < cropped.counts.size()) cropped_.resize(cropped.counts.size());
  for (std::size_t i = 0; i < cropped.counts.size(); ++i) cropped_[i] += cropped.counts[i];
  return deskew(std::move(cropped.scan), end_T_column);
}

/**
 * Registers the scan, and hands the result to the smoother, whose robust loss follows one that contradicts the IMU only
 * slowly. Such a one is not trusted.
 */
void LidarInertialSlam::locate(const std::vector<View>& views, StateEstimate& estimate)
{
  estimate.covariance = times_.measure("smoother", [&] { return smoother_->newestBodyCovariance(); });
  const bool known = estimate.covariance.allFinite() && estimate.covariance.llt().info() == Eigen::Success;
  if (local_map_.empty() || estimate.points == 0 || !known) return;
  const PoseGuess guess(map_T_local().inverse() * bodyAt(smoother_->newest()), estimate.covariance);
  estimate.registration = registerScan(local_map_.ndt(), views, guess, settings_, times_);
  const RegistrationResult& registration = *estimate.registration;
  if (registration.outcome == Outcome::LowOverlap) return;
  const PoseGuess either(guess.target_T_source, *guess.covariance + registration.covariance);
  estimate.surprise = std::sqrt(surprise(either, registration.target_T_source));
  contradiction_.add(estimate.stamp, estimate.surprise);
  estimate.trusted =
      registration.trustworthy() && (settings_.slam.gate == 0 || estimate.surprise <= settings_.slam.gate);
  addToSmoother(registration);
}

/**
 * Cells that lie wrong, leaves seen from one side and occlusions are the same from scan to scan until the machine has
 * moved: as independent measurements they would outvote the IMU by their number.
 */
void LidarInertialSlam::addToSmoother(const RegistrationResult& registration)
{
  constexpr double kLeastTravel = 0.02;  // m: at rest many scans count as one, but not as none
  const Rigid& local_T_body = registration.target_T_source;
  const double travel = last_registered_ ? (local_T_body.translation - last_registered_->translation).norm() : 0;
  const double alike = std::max(1.0, settings_.slam.correlation / std::max(travel, kLeastTravel));
  last_registered_ = local_T_body;
  const Matrix6d information = registration.information / alike;
  if (smoother_->hasAnchor())
    smoother_->addRelativePose(smoother_->anchor().stamp, local_T_anchor_.inverse() * local_T_body, information);
  else
    smoother_->addPosePrior(local_T_body, information);
}

Rigid LidarInertialSlam::map_T_local() const
{
  if (!smoother_->hasAnchor()) return Rigid::identity();
  return bodyAt(smoother_->anchor()) * local_T_anchor_.inverse();
}

/**
 * Once a second: looks for the body about where it was last seen, as far as a machine drives since. Its tilt and, every
 * other time, its heading are the IMU's, which may have lied: every other time all headings are tried.
 */
bool LidarInertialSlam::recover(const std::vector<View>& views, StateEstimate& estimate)
{
  constexpr Duration kPatience = 1s;
  constexpr double kSpeed = 1.5, kFarthest = 10;  // m/s, m
  constexpr double kAsGood = 0.75;                // times the score with which it was last seen
  if (local_map_.empty() || estimate.points == 0 || !last_seen_) return false;
  if (tried_to_recover_ && estimate.stamp - *tried_to_recover_ < kPatience) return false;
  const bool all_around = tried_to_recover_.has_value() && !tried_all_around_;
  tried_to_recover_ = estimate.stamp;
  tried_all_around_ = all_around;

  const double since = seconds(estimate.stamp - last_trusted_);
  const SearchArea area{
      {(map_T_local().inverse() * estimate.map_T_body).rotation, last_seen_->registration.target_T_source.translation},
      std::min(kFarthest, kSpeed * since),
      all_around ? 8 : 1};
  const auto found = times_.measure("recovery", [&] { return relocalise(local_map_.ndt(), views, area, settings_); });
  if (!found || found->score > kAsGood * last_seen_->registration.score) return false;  // scores are negative
  restartAt(found->target_T_source, covarianceWithin(area, *found));
  estimate.registration = found;
  estimate.map_T_body = bodyAt(smoother_->newest());
  estimate.covariance = smoother_->newestBodyCovariance();
  estimate.velocity = smoother_->newest().velocity;
  estimate.trusted = estimate.recovered = true;
  ++recoveries_;
  tried_to_recover_.reset();
  contradiction_.clear();
  return true;
}

/**
 * A new window from here. Map, local map and biases lie to each other as when the body was last seen: what the IMU
 * said since, and registrations that contradicted it, would tilt them.
 */
void LidarInertialSlam::restartAt(const Rigid& local_T_body, const Matrix6d& covariance)
{
  begin(foundAt(last_seen_->map_T_local * local_T_body, covariance, newest(), last_seen_->bias, body_T_imu_,
                settings_.imu.accel_bias_sigma));
  last_registered_.reset();
  anchorAt(local_T_body);
}

NavEstimate LidarInertialSlam::newest() const { return {smoother_->newest(), smoother_->newestCovariance()}; }

void LidarInertialSlam::anchorAt(const Rigid& local_T_body)
{
  if (!settings_.slam.relative) return;
  smoother_->anchorNewest();
  local_T_anchor_ = local_T_body;
}

void LidarInertialSlam::updateMap(PointCloud cloud, const std::vector<View>& views, StateEstimate& estimate)
{
  if (cloud.empty()) return;
  const bool lost_for_good =
      estimate.health == Health::Lost &&
      estimate.stamp - last_trusted_ > fromSeconds(settings_.slam.lost_after + settings_.slam.restart_after);
  if (lost_for_good && !local_map_.empty())
  {
    ++map_restarts_;
    local_map_.clear();
    last_seen_.reset();
    tried_to_recover_.reset();
    contradiction_.clear();
    last_trusted_ = estimate.stamp;
  }
  const bool trusted = estimate.trusted && !contradicts() && estimate.registration->outcome == Outcome::Converged;
  if (local_map_.empty() || (trusted && local_map_.wants(map_T_local().inverse() * estimate.map_T_body)))
    addKeyframe(std::move(cloud), views, estimate);
}

/** Aligned again with finer cells, as far as the estimate leaves it open, then added to the local map. */
void LidarInertialSlam::addKeyframe(PointCloud cloud, const std::vector<View>& views, StateEstimate& estimate)
{
  times_.measure("keyframe",
                 [&]
                 {
                   const Rigid map_T_local = this->map_T_local();
                   const Rigid estimated = map_T_local.inverse() * estimate.map_T_body;
                   Rigid local_T_body = estimated;
                   if (!local_map_.empty())
                   {
                     const NdtMap source(views, settings_.keyframe_cells);
                     const PoseGuess guess(estimated, smoother_->newestBodyCovariance());
                     const RegistrationResult fine = align(local_map_.ndt(), source, guess, settings_.fine);
                     if (fine.trustworthy()) local_T_body = fine.target_T_source;
                   }
                   local_map_.add(views, local_T_body);
                   estimate.keyframe = Keyframe{estimate.stamp, map_T_local * local_T_body, std::move(cloud)};
                   if (!smoother_->hasAnchor()) anchorAt(estimated);
                 });
}

Health LidarInertialSlam::healthOf(const StateEstimate& estimate)
{
  const bool opens_the_map = local_map_.empty() && estimate.points > 0;
  const bool trusted = opens_the_map || estimate.trusted;
  if (trusted && !contradicts()) last_trusted_ = estimate.stamp;
  if (estimate.trusted) last_seen_ = {*estimate.registration, map_T_local(), smoother_->newest().bias};
  const bool for_long = estimate.stamp - last_trusted_ > fromSeconds(settings_.slam.lost_after);
  if (for_long || contradicts()) return Health::Lost;
  if (initialising_until_ && estimate.stamp <= *initialising_until_) return Health::Initialising;
  return trusted ? Health::Ok : Health::Degenerate;
}

bool LidarInertialSlam::contradicts() const
{
  return settings_.slam.contradiction > 0 && contradiction_.median() > settings_.slam.contradiction;
}

Rigid LidarInertialSlam::bodyAt(const NavState& state) const { return state.map_T_imu * imu_T_body_; }
}  // namespace scanloom
