#include "estimation/slam/internal/HealthMonitor.h"

#include "base/core/Decompositions.h"
#include "estimation/ndt/LidarInformation.h"

namespace scanloom
{
namespace
{
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

DeadReckoning motionWhileLost(const TrackerState& state, const StateEstimate& estimate)
{
  return {estimate.velocity - state.last_good.velocity, estimate.stamp - state.last_good.stamp};
}
}  // namespace

HealthMonitor::HealthMonitor(const SlamSettings& settings)
  : tracking_(settings.slam.tracking),
    trust_(settings.slam.trust),
    smoother_(settings.smoother),
    registration_(settings.registration)
{
}

void HealthMonitor::gate(const PoseGuess& predicted, TrustHistory& history, StateEstimate& estimate) const
{
  const RegistrationResult& registration = *estimate.registration;
  estimate.surprise = surpriseOf(registration, predicted);
  const bool usable = history.lost ? registration.outcome == Outcome::Converged : registration.trustworthy();
  estimate.trusted = usable && (tracking_.gate == 0 || estimate.surprise <= tracking_.gate);
  if (history.imu_silent)
    history.contradiction.clear();
  else
    history.contradiction.add(estimate.stamp, estimate.surprise);
}

HealthDecision HealthMonitor::assess(const std::vector<View>& views, const NavState& before, TrackerState& state,
                                     StateEstimate& estimate, StageTimes& times) const
{
  compareWithRegistration(estimate, state);
  HealthDecision decision;
  decision.contradicted = assessedAndMended(views, state, estimate, times).contradicted;
  const bool lost_for_good =
      estimate.health == Health::Lost &&
      estimate.stamp - state.trust.last_trusted > fromSeconds(trust_.lost_after + trust_.restart_after);
  if (lost_for_good)
    decision.begins_map = giveUpMap(before, state, estimate);
  else if (state.resting_since)
  {
    state.resting_since.reset();
    state.before_window = state.last_good.since_start;  // seen in the same map: no rest in between counts
  }
  return decision;
}

/** Where IMU and lidar err by much, the estimate between both is near neither. */
void HealthMonitor::compareWithRegistration(const StateEstimate& estimate, TrackerState& state) const
{
  if (!estimate.registration || !estimate.trusted) return;
  const RegistrationResult& seen = *estimate.registration;
  const Vector6d apart = boxMinus(state.map_T_local().inverse() * estimate.map_T_body, seen.target_T_source);
  const Matrix6d shared = state.shared_attitude_noise.covariance(upInBody(estimate.map_T_body));
  state.trust.divergence.add(apart, estimate.covariance + seen.covariance + shared);
}

Assessment HealthMonitor::assessedAndMended(const std::vector<View>& views, TrackerState& state,
                                            StateEstimate& estimate, StageTimes& times) const
{
  const Assessment assessment = assessed(state, estimate);
  if (state.trust.divergence.level() == Divergence::Persistent)
  {
    acceptLidar(state, estimate);
    return assessment;
  }
  const bool blind = assessment.health == Health::Lost && !assessment.contradicted && !isWhereItIsSaidToBe(estimate);
  return blind && recover(views, state, estimate, times) ? assessed(state, estimate) : assessment;
}

/** Sets the estimate's health, and remembers what the next scans are judged by. */
Assessment HealthMonitor::assessed(TrackerState& state, StateEstimate& estimate) const
{
  const bool opens_map = state.local_map.empty() && !estimate.cloud.empty();
  const Assessment assessment = scanloom::assess(estimate, opens_map, state.trust, trust_);
  estimate.health = assessment.health;
  state.trust.lost = assessment.health == Health::Lost;
  state.trust.last_trusted = assessment.last_trusted;
  if (estimate.trusted && state.trust.divergence.level() == Divergence::None)
    state.relocalisation.remember({estimate.registration->target_T_source, estimate.registration->score,
                                   state.map_T_local(), state.smoother.newest().bias});
  return assessment;
}

bool HealthMonitor::recover(const std::vector<View>& views, TrackerState& state, StateEstimate& estimate,
                            StageTimes& times) const
{
  if (state.local_map.empty() || estimate.cloud.empty()) return false;
  const LostBody lost{(state.map_T_local().inverse() * estimate.map_T_body).rotation,
                      estimate.map_T_body.rotation.conjugate() * meanForce(motionWhileLost(state, estimate)),
                      estimate.stamp - state.trust.last_trusted};
  const std::optional<FoundBody> found =
      state.relocalisation.search(state.local_map.ndt(), views, lost, withLimitedEffort(registration_), times);
  if (!found) return false;
  beginAgainAt(*found, state, estimate);
  state.trust.contradiction.clear();
  return true;
}

/** An error of the IMU stays in the velocity: without a new window the lidar would pull at it for seconds. */
void HealthMonitor::acceptLidar(TrackerState& state, StateEstimate& estimate) const
{
  constexpr Duration kAgain = 10s;  // where lidar and IMU always contradict each other, InnovationMonitor must see it
  const FoundBody seen{*estimate.registration, estimate.registration->covariance};
  std::optional<Timestamp>& believed = state.trust.lidar_believed;
  const bool too_often = believed && estimate.stamp - *believed < kAgain && !state.trust.imu_silent;
  if (too_often || !state.relocalisation.lastSeen() || !isPositiveDefinite(seen.covariance)) return;
  beginAgainAt(seen, state, estimate);
  believed = estimate.stamp;
}

/**
 * Begins a new window where the body is found. The map frame and the biases are those of the last trusted scan: what
 * the IMU read since then, and registrations that contradicted it, would tilt them.
 */
void HealthMonitor::beginAgainAt(const FoundBody& found, TrackerState& state, StateEstimate& estimate) const
{
  constexpr double kSmear = 0.15;  // m: the scan, of 0.1 s, was deskewed by a motion that may be wrong by 1.5 m/s
  const Rigid& local_T_body = found.registration.target_T_source;
  const LastSeen& seen = *state.relocalisation.lastSeen();
  const MountedImu imu = state.imu();
  Matrix6d covariance = found.covariance;
  covariance.diagonal().head<3>().array() += kSmear * kSmear;
  beginWindow(foundAt(seen.map_T_local * local_T_body, covariance, state.newest(), seen.bias, imu), imu,
              seen.map_T_local, state);
  state.before_window = state.last_good.since_start;
  state.trust.divergence = {};

  estimate.registration = found.registration;
  estimate.map_T_body = state.smoother.newestBody();
  estimate.covariance = state.smoother.newestBodyCovariance();
  estimate.velocity = state.smoother.newest().velocity;
  estimate.trusted = estimate.recovered = true;
}

/**
 * Whether the scan begins a new map. The body moves on as the IMU says, unless that does not know its velocity any
 * more, or cannot be right, or no scan was ever found in the map (the velocity is older than that): then it rests. A
 * scan that was deskewed by an impossible motion begins no map.
 */
bool HealthMonitor::giveUpMap(const NavState& before, TrackerState& state, StateEstimate& estimate) const
{
  const Eigen::Quaterniond map_R_body = state.smoother.newestBody().rotation;
  const bool sees = state.scans_seen > 1;
  if (state.resting_since)
  {
    comeToRest({map_R_body}, before, state, estimate);
    return sees;
  }
  const DeadReckoning motion = motionWhileLost(state, estimate);
  const NavEstimate newest = state.newest();
  if (state.relocalisation.lastSeen() && isPossible(motion) && knowsVelocity(newest))
  {
    if (sees) beginWindow(newest, state.imu(), state.map_T_local(), state);
    return sees;
  }
  state.resting_since = before.stamp;
  comeToRest(levelledByMeanForce(map_R_body, motion), before, state, estimate);
  return false;
}

/** At the place before. How far the body may be from there is not for the smoother: it computes with differences of a
 * millimetre. */
void HealthMonitor::comeToRest(const Attitude& attitude, const NavState& before, TrackerState& state,
                               StateEstimate& estimate) const
{
  const MountedImu imu = state.imu();
  const Rigid map_T_body{attitude.map_R_body, (before.map_T_imu * imu.body_T_imu.inverse()).translation};
  beginWindow(atRest(map_T_body, attitude.tilt_sigma, state.newest(), imu), imu, state.map_T_local(), state);

  const double reach = kMachineSpeed * seconds(estimate.stamp - *state.resting_since);
  estimate.map_T_body = map_T_body;
  estimate.covariance = state.smoother.newestBodyCovariance();
  estimate.velocity.setZero();
  state.before_window = state.last_good.since_start;
  for (Matrix6d* covariance : {&estimate.covariance, &state.before_window})
    covariance->diagonal().head<3>().array() += reach * reach;
}

void HealthMonitor::beginWindow(const NavEstimate& newest, const MountedImu& imu, const Rigid& map_T_local,
                                TrackerState& state) const
{
  state.smoother = windowFrom(newest, imu, smoother_);
  state.measurement_correlation = {};
  state.map_T_local_without_anchor = map_T_local;
}
}  // namespace scanloom
