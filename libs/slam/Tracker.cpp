#include "slam/Tracker.h"

#include "core/Matrix6.h"
#include "ndt/LidarInformation.h"
#include "ndt/Rivals.h"
#include "preprocessing/Deskew.h"
#include "slam/BodyPoses.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scanloom
{
namespace
{
std::vector<Eigen::Vector3d> positionsOf(const std::vector<MountedLidar>& lidars)
{
  std::vector<Eigen::Vector3d> positions;
  for (const MountedLidar& lidar : lidars) positions.push_back(lidar.body_T_sensor.translation);
  return positions;
}

/** m, from the last registration. */
double travelTo(const Rigid& local_T_body, const TrackerState& state)
{
  return state.last_registered ? (local_T_body.translation - state.last_registered->translation).norm() : 0;
}

/**
 * How many registrations, `travel` m apart, count as one if their errors stay the same over `length` m: as independent
 * measurements they would outvote the IMU by their number.
 */
double registrationsPerMeasurement(double travel, double length)
{
  constexpr double kLeastTravel = 0.02;  // m: at rest many scans count as one, but not as none
  return std::max(1.0, length / std::max(travel, kLeastTravel));
}

Eigen::Vector3d upInBody(const Rigid& map_T_body) { return map_T_body.rotation.conjugate() * Eigen::Vector3d::UnitZ(); }

/**
 * Of a registration among others. Errors of the map's cells, leaves seen from one side and occlusions stay the same
 * from scan to scan until the machine has moved by `correlation` m; those of the attitude on the length of the map.
 */
Matrix6d informationAmongOthers(const RegistrationResult& registration, const AttitudeDoubt& doubt,
                                const Eigen::Vector3d& up, double travel, double correlation)
{
  return informationWithError(registration.information / registrationsPerMeasurement(travel, correlation),
                              registrationsPerMeasurement(travel, doubt.length()) * doubt.covariance(up));
}

/**
 * The scan agrees with the map where the IMU says that the body is, but leaves a direction open, along which the body
 * can hardly have moved. A search would only find another place that looks alike.
 */
bool isWhereItIsSaidToBe(const StateEstimate& estimate)
{
  constexpr double kReach = 2;  // m: an alignment finds the pose from there
  return estimate.registration && estimate.registration->outcome == Outcome::Degenerate &&
         3 * largestDeviation(estimate.covariance) < kReach;
}

NavEstimate newestOf(const FixedLagSmoother& smoother) { return {smoother.newest(), smoother.newestCovariance()}; }
}  // namespace

Rigid TrackerState::map_T_local() const
{
  return smoother.hasAnchor() ? smoother.anchorBody() * local_T_anchor.inverse() : Rigid::identity();
}

Tracker::Tracker(const SlamSettings& settings, const std::vector<MountedLidar>& lidars)
  : settings_(settings), limited_effort_(withLimitedEffort(settings.registration))
{
  if (settings.slam.tracking.stem_axes) viewpoints_ = positionsOf(lidars);
}

FixedLagSmoother Tracker::windowFrom(const NavEstimate& start, const PlacedImu& imu) const
{
  return {start.state, start.covariance, imu.body_T_imu, imu.noise, settings_.smoother};
}

TrackerState Tracker::begin(const NavEstimate& start, const PlacedImu& imu) const
{
  TrackerState state{
      windowFrom(start, imu), LocalMap(settings_.local_map, settings_.map_cells), {}, {}, {}, {}, {}, {}, {}};
  state.trust.last_trusted = start.state.stamp;
  return state;
}

TrackedScan Tracker::step(TrackerState state, Scan scan, const std::vector<ImuSample>& samples, StageTimes& times) const
{
  StateEstimate estimate;
  estimate.stamp = scan.end();
  estimate.scan_complete = scan.complete();
  const NavState before = state.smoother.newest();

  const Prediction predicted = predict(samples, state, times);
  Seen seen = preprocess(std::move(scan), before, samples, state, times);
  estimate.cloud = std::move(seen.cloud);
  locate(seen, predicted, state, estimate, times);
  smooth(before, samples, predicted, state, estimate, times);
  compareWithRegistration(estimate, state);
  const bool contradicted = judgeAndRecover(seen, state, estimate, times);
  if (isLostForGood(state, estimate))
    comeToRest(before, state, estimate);
  else
    state.resting_since.reset();
  estimate.correction = boxMinus(estimate.map_T_body, predicted.map_T_body);
  state.motion_since_last = estimate.recovered ? Trajectory{} : estimate.since_last;
  updateMap(seen, contradicted, state, estimate, times);
  estimate.drift = driftOf(state, estimate);
  return {std::move(state), std::move(estimate)};
}

/** Of the local map, and of its tilt, which is known as well as the accelerometer's bias. */
Matrix6d Tracker::driftOf(const TrackerState& state, const StateEstimate& estimate) const
{
  Matrix6d drift = state.local_map.drift(state.map_T_local().inverse() * estimate.map_T_body);
  const FixedLagSmoother& smoother = state.smoother;
  const Eigen::Matrix3d body_R_imu = smoother.body_T_imu().rotation.toRotationMatrix();
  const Eigen::Vector3d up = upInBody(estimate.map_T_body);
  const Eigen::Matrix3d to_tilt = (Eigen::Matrix3d::Identity() - up * up.transpose()) * body_R_imu;
  drift.bottomRightCorner<3, 3>() += to_tilt * smoother.newestCovariance().block<3, 3>(3, 3) * to_tilt.transpose();
  return drift;
}

/** The newest state becomes the one at the end of the samples, as the IMU predicts it. */
Tracker::Prediction Tracker::predict(const std::vector<ImuSample>& samples, TrackerState& state,
                                     StageTimes& times) const
{
  FixedLagSmoother& smoother = state.smoother;
  const ImuBias bias = smoother.newest().bias;
  smoother.addState(times.measure("preintegration", [&] { return preintegrate(samples, bias, smoother.noise()); }));
  return {smoother.newestBody(), times.measure("smoother", [&] { return smoother.newestBodyCovariance(); })};
}

/** Moved to where each point is seen from the body at the end of the scan. */
Tracker::Seen Tracker::preprocess(Scan scan, const NavState& before, const std::vector<ImuSample>& samples,
                                  const TrackerState& state, StageTimes& times) const
{
  Seen seen;
  const auto period = static_cast<std::int32_t>(scan.period.count());
  seen.cloud = times.measure(
      "deskew",
      [&]
      {
        const Rigid imu_T_body = state.smoother.body_T_imu().inverse();
        const Rigid end_T_map = (predictAt(before, samples, {scan.end()}).front().map_T_imu * imu_T_body).inverse();
        std::vector<Rigid> end_T_column;
        for (const Rigid& map_T_body : bodyAtColumns(scan, before, samples, imu_T_body, state.motion_since_last))
          end_T_column.push_back(end_T_map * map_T_body);
        PointCloud cloud = deskew(std::move(scan), end_T_column);
        for (std::int32_t& t : cloud.t) t -= period;  // it counts from the end now
        return cloud;
      });
  seen.views = times.measure("deskew", [&] { return viewsOf(seen.cloud, viewpoints_); });
  return seen;
}

/** Registers the scan to the local map, and hands the result to the smoother. */
void Tracker::locate(const Seen& seen, const Prediction& predicted, TrackerState& state, StateEstimate& estimate,
                     StageTimes& times) const
{
  if (state.local_map.empty() || estimate.cloud.empty() || !isPositiveDefinite(predicted.covariance)) return;
  const NdtMap& map = state.local_map.ndt();
  const PoseGuess guess(state.map_T_local().inverse() * predicted.map_T_body, predicted.covariance);
  estimate.registration =
      state.trust.lost
          // The effort is the search's: the prediction of an IMU that lost the body is worth little.
          ? registerFinely(map, seen.views, guess.target_T_source, limited_effort_, times)
          : registerScan(seen.views, guess, state, times);
  if (estimate.registration->outcome != Outcome::LowOverlap) addRegistration(guess, state, estimate);
}

RegistrationResult Tracker::registerScan(const std::vector<View>& views, const PoseGuess& guess,
                                         const TrackerState& state, StageTimes& times) const
{
  const NdtMap& map = state.local_map.ndt();
  const ScanRegistrationOptions& options = settings_.registration;
  if (!settings_.slam.tracking.refine) return registerRoughly(map, views, guess, options, times);
  const std::optional<LastSeen>& seen = state.recovery.lastSeen();
  const std::optional<double> usual_score = seen ? std::optional(seen->score) : std::nullopt;
  return registerTwice(map, views, guess, usual_score, options, times);
}

/** The smoother's robust loss follows a registration that contradicts the IMU only slowly; such a one is not trusted.
 */
void Tracker::addRegistration(const PoseGuess& predicted, TrackerState& state, StateEstimate& estimate) const
{
  const TrackingOptions& options = settings_.slam.tracking;
  const RegistrationResult& registration = *estimate.registration;
  const Rigid& local_T_body = registration.target_T_source;
  estimate.surprise = surpriseOf(registration, predicted);
  const bool usable = state.trust.lost ? registration.outcome == Outcome::Converged : registration.trustworthy();
  estimate.trusted = usable && (options.gate == 0 || estimate.surprise <= options.gate);
  if (state.trust.imu_silent)
    state.trust.contradiction.clear();
  else
    state.trust.contradiction.add(estimate.stamp, estimate.surprise);

  const Eigen::Vector3d up = upInBody(state.map_T_local() * local_T_body);
  const double travel = travelTo(local_T_body, state);
  state.attitude_doubt.add(registration, up, state.local_map.oldest(), travel);
  const Matrix6d information =
      informationAmongOthers(registration, state.attitude_doubt, up, travel, options.correlation);
  state.last_registered = local_T_body;
  FixedLagSmoother& smoother = state.smoother;
  if (smoother.hasAnchor())
    smoother.addRelativePose(smoother.anchor().stamp, state.local_T_anchor.inverse() * local_T_body, information);
  else
    smoother.addPosePrior(local_T_body, information);
}

void Tracker::smooth(const NavState& before, const std::vector<ImuSample>& samples, const Prediction& predicted,
                     TrackerState& state, StateEstimate& estimate, StageTimes& times) const
{
  FixedLagSmoother& smoother = state.smoother;
  const NavState after = times.measure("smoother", [&] { return smoother.optimise(); });
  estimate.map_T_body = smoother.newestBody();
  estimate.covariance = smoother.bodyCovarianceAfter(predicted.covariance);
  estimate.velocity = after.velocity;
  estimate.since_last = posesBetween(before, after, samples, smoother.body_T_imu().inverse());
}

/** Where IMU and lidar err by much, the estimate between both is near neither. */
void Tracker::compareWithRegistration(const StateEstimate& estimate, TrackerState& state) const
{
  if (!estimate.registration || !estimate.trusted) return;
  const RegistrationResult& seen = *estimate.registration;
  const Vector6d apart = boxMinus(state.map_T_local().inverse() * estimate.map_T_body, seen.target_T_source);
  const Matrix6d shared = state.attitude_doubt.covariance(upInBody(estimate.map_T_body));
  state.trust.separation.add(apart, estimate.covariance + seen.covariance + shared);
}

/**
 * Searches the body where it is lost and the lidar does not contradict that; believes the lidar where the IMU has
 * carried the estimate away from it. Returns Assessment::contradicted.
 */
bool Tracker::judgeAndRecover(const Seen& seen, TrackerState& state, StateEstimate& estimate, StageTimes& times) const
{
  const Assessment assessed = judge(state, estimate);
  if (state.trust.separation.lasts())
  {
    believeLidar(state, estimate);
    return assessed.contradicted;
  }
  const bool blind = assessed.health == Health::Lost && !assessed.contradicted && !isWhereItIsSaidToBe(estimate);
  return blind && recover(seen.views, state, estimate, times) ? judge(state, estimate).contradicted
                                                              : assessed.contradicted;
}

/** Sets the estimate's health, and remembers what the next scans are judged by. */
Assessment Tracker::judge(TrackerState& state, StateEstimate& estimate) const
{
  const bool opens_map = state.local_map.empty() && !estimate.cloud.empty();
  const Assessment assessed = assess(estimate, opens_map, state.trust, settings_.slam.trust);
  estimate.health = assessed.health;
  state.trust.lost = assessed.health == Health::Lost;
  state.trust.last_trusted = assessed.last_trusted;
  if (estimate.trusted && !state.trust.separation.suspected())
    state.recovery.remember({estimate.registration->target_T_source, estimate.registration->score, state.map_T_local(),
                             state.smoother.newest().bias});
  return assessed;
}

bool Tracker::recover(const std::vector<View>& views, TrackerState& state, StateEstimate& estimate,
                      StageTimes& times) const
{
  if (state.local_map.empty() || estimate.cloud.empty()) return false;
  const LostBody lost{estimate.stamp, (state.map_T_local().inverse() * estimate.map_T_body).rotation,
                      estimate.stamp - state.trust.last_trusted};
  const std::optional<FoundBody> found =
      state.recovery.search(state.local_map.ndt(), views, lost, limited_effort_, times);
  if (!found) return false;
  beginAgainAt(*found, state, estimate);
  state.trust.contradiction.clear();
  return true;
}

/** An error of the IMU stays in the velocity: without a new window the lidar would pull at it for seconds. */
void Tracker::believeLidar(TrackerState& state, StateEstimate& estimate) const
{
  constexpr Duration kAgain = 10s;  // where lidar and IMU always contradict each other, Contradiction must see it
  const FoundBody seen{*estimate.registration, estimate.registration->covariance};
  std::optional<Timestamp>& believed = state.trust.lidar_believed;
  const bool too_often = believed && estimate.stamp - *believed < kAgain && !state.trust.imu_silent;
  if (too_often || !state.recovery.lastSeen() || !isPositiveDefinite(seen.covariance)) return;
  beginAgainAt(seen, state, estimate);
  believed = estimate.stamp;
}

/**
 * Begins a new window where the body is found. The map frame and the biases are those of the last trusted scan: what
 * the IMU read since then, and registrations that contradicted it, would tilt them.
 */
void Tracker::beginAgainAt(const FoundBody& found, TrackerState& state, StateEstimate& estimate) const
{
  const Rigid& local_T_body = found.registration.target_T_source;
  const LastSeen& seen = *state.recovery.lastSeen();
  const PlacedImu imu{state.smoother.body_T_imu(), state.smoother.noise()};
  state.smoother = windowFrom(
      foundAt(seen.map_T_local * local_T_body, found.covariance, newestOf(state.smoother), seen.bias, imu), imu);
  state.last_registered.reset();
  state.trust.separation = {};
  anchorAt(local_T_body, state);

  estimate.registration = found.registration;
  estimate.map_T_body = state.smoother.newestBody();
  estimate.covariance = state.smoother.newestBodyCovariance();
  estimate.velocity = state.smoother.newest().velocity;
  estimate.trusted = estimate.recovered = true;
}

/** The IMU's attitude at the place before. How far the body may be from there is not for the smoother: it computes
 * with differences of a millimetre. */
void Tracker::comeToRest(const NavState& before, TrackerState& state, StateEstimate& estimate) const
{
  constexpr double kSpeed = 1.5;  // m/s, a machine's
  const PlacedImu imu{state.smoother.body_T_imu(), state.smoother.noise()};
  const Rigid map_T_local = state.map_T_local();
  const Rigid map_T_body{state.smoother.newestBody().rotation,
                         (before.map_T_imu * imu.body_T_imu.inverse()).translation};
  state.smoother = windowFrom(atRest(map_T_body, newestOf(state.smoother), imu), imu);
  state.last_registered.reset();
  anchorAt(map_T_local.inverse() * map_T_body, state);

  if (!state.resting_since) state.resting_since = before.stamp;
  const double reach = kSpeed * seconds(estimate.stamp - *state.resting_since);
  estimate.map_T_body = map_T_body;
  estimate.covariance = state.smoother.newestBodyCovariance();
  estimate.covariance.diagonal().head<3>().array() += reach * reach;
  estimate.velocity.setZero();
}

/** Registrations from now on are relative to the newest body, which is there in the local map. */
void Tracker::anchorAt(const Rigid& local_T_body, TrackerState& state) const
{
  if (!settings_.slam.tracking.relative) return;
  state.smoother.anchorNewest();
  state.local_T_anchor = local_T_body;
}

bool Tracker::isLostForGood(const TrackerState& state, const StateEstimate& estimate) const
{
  const TrustOptions& trust = settings_.slam.trust;
  return estimate.health == Health::Lost &&
         estimate.stamp - state.trust.last_trusted > fromSeconds(trust.lost_after + trust.restart_after);
}

void Tracker::updateMap(const Seen& seen, bool contradicted, TrackerState& state, StateEstimate& estimate,
                        StageTimes& times) const
{
  if (estimate.cloud.empty()) return;
  if (isLostForGood(state, estimate) && !state.local_map.empty())
  {
    estimate.map_restarted = true;
    state.local_map.clear();
    state.recovery.forget();
    state.trust.contradiction.clear();
    state.trust.last_trusted = estimate.stamp;
  }
  const bool sure = estimate.trusted && !contradicted && !state.trust.separation.suspected() &&
                    estimate.registration->outcome == Outcome::Converged;
  if (state.local_map.empty() || (sure && state.local_map.wants(state.map_T_local().inverse() * estimate.map_T_body)))
    times.measure("keyframe", [&] { addKeyframe(seen, state, estimate); });
}

/** Aligns the scan again with finer cells, within the covariance of the estimate, and adds it to the local map. */
void Tracker::addKeyframe(const Seen& seen, TrackerState& state, StateEstimate& estimate) const
{
  const Rigid map_T_local = state.map_T_local();
  const Rigid estimated = map_T_local.inverse() * estimate.map_T_body;
  Rigid local_T_body = estimated;
  Matrix6d alignment = state.smoother.newestBodyCovariance();
  if (!state.local_map.empty())
  {
    const NdtMap source(seen.views, settings_.keyframe_cells, Grid::Turned);
    const PoseGuess guess(estimated, alignment);
    const RegistrationResult fine = align(state.local_map.ndt(), source, guess, settings_.registration.fine);
    if (fine.trustworthy())
    {
      local_T_body = withAttitudeOf(estimated, alignment, fine, upInBody(estimate.map_T_body), state.attitude_doubt);
      alignment = inverse(fine.information + inverse(alignment));
    }
  }
  state.local_map.add(seen.views, local_T_body, alignment);
  estimate.keyframe = Keyframe{estimate.stamp, map_T_local * local_T_body, estimate.cloud};
  if (!state.smoother.hasAnchor()) anchorAt(estimated, state);
}

TrackerState Tracker::changeImu(TrackerState state, const ImuChange& change) const
{
  const Rigid local_T_body = state.map_T_local().inverse() * state.smoother.newestBody();
  const bool anchored = state.smoother.hasAnchor();
  const NavEstimate start = continuedBy(change, newestOf(state.smoother), state.smoother.body_T_imu());
  state.smoother = windowFrom(start, change.imu);
  if (anchored) anchorAt(local_T_body, state);
  state.recovery.changeBias(start.state.bias);
  return state;
}
}  // namespace scanloom
