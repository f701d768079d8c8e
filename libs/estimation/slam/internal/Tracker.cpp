#include "estimation/slam/internal/Tracker.h"

#include "base/core/Decompositions.h"
#include "estimation/graph/PosePriorFactor.h"
#include "estimation/preprocessing/Deskew.h"
#include "estimation/slam/internal/BodyPoses.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scanloom
{
namespace
{
/** Covariance of the pose relative to the first one: as the smoother knows it, and from before its window began. */
Matrix6d errorSinceStart(const Rigid& map_T_body, const TrackerState& state)
{
  const Matrix6d of_imu = state.smoother.newestCovariance().topLeftCorner<6, 6>();
  return movedTo(state.smoother.body_T_imu().inverse(), of_imu) + movedTo(map_T_body, state.before_window);
}

/** Covariance of the pose relative to the first one, from what all registrations err alike: structure that is seen from
 * one side shortens the way, and what is seen from nearer than the map saw it lifts it. */
Matrix6d scaleError(const Rigid& map_T_body)
{
  constexpr double kShare = 6e-4;  // by the NEES of simulated drives (doc/study/localisation.md#consistency)
  const Eigen::Vector3d way = map_T_body.rotation.conjugate() * map_T_body.translation;
  const Eigen::Vector3d up = upInBody(map_T_body) * way.norm();
  Matrix6d covariance = Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>() = kShare * kShare * (way * way.transpose() + up * up.transpose());
  return covariance;
}
}  // namespace

Tracker::Tracker(const SlamSettings& settings, const std::vector<MountedLidar>& lidars)
  : settings_(settings), health_monitor_(settings)
{
  if (settings.slam.tracking.stem_axes) body_T_lidar_ = posesOf(lidars);
}

TrackerState Tracker::begin(const NavEstimate& start, const MountedImu& imu) const
{
  TrackerState state{windowFrom(start, imu, settings_.smoother), LocalMap(settings_.local_map, settings_.map_cells)};
  state.trust.last_trusted = start.state.stamp;
  state.last_good = {start.state.stamp, start.state.velocity};
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
  state.scans_seen = estimate.cloud.empty() ? 0 : state.scans_seen + 1;
  locate(seen, predicted, state, estimate, times);
  smooth(before, samples, predicted, state, estimate, times);
  const HealthDecision decision = health_monitor_.assess(seen.views, before, state, estimate, times);
  estimate.correction = boxMinus(estimate.map_T_body, predicted.map_T_body);
  state.motion_since_last = estimate.recovered ? Trajectory{} : estimate.since_last;
  updateMap(seen, decision, state, estimate, times);
  const Matrix6d since_start = errorSinceStart(estimate.map_T_body, state);
  if (!state.trust.lost)
    state.last_good = {estimate.stamp, estimate.velocity, movedTo(estimate.map_T_body.inverse(), since_start)};
  estimate.since_start = since_start + scaleError(estimate.map_T_body);
  return {std::move(state), std::move(estimate)};
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
  seen.views = times.measure("deskew", [&] { return viewsOf(seen.cloud, body_T_lidar_); });
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
          ? registerFinely(map, seen.views, guess.target_T_source, withLimitedEffort(settings_.registration), times)
          : registerScan(seen.views, guess, state, times);
  if (estimate.registration->outcome != Outcome::LowOverlap) addRegistration(guess, state, estimate);
}

RegistrationResult Tracker::registerScan(const std::vector<View>& views, const PoseGuess& guess,
                                         const TrackerState& state, StageTimes& times) const
{
  const NdtMap& map = state.local_map.ndt();
  const ScanRegistrationOptions& options = settings_.registration;
  if (!settings_.slam.tracking.refine) return registerRoughly(map, views, guess, options, times);
  const std::optional<LastSeen>& seen = state.relocalisation.lastSeen();
  const std::optional<double> usual_score = seen ? std::optional(seen->score) : std::nullopt;
  return registerTwice(map, views, guess, usual_score, options, times);
}

/** The smoother's robust loss follows a registration that contradicts the IMU only slowly; such a one is not trusted.
 */
void Tracker::addRegistration(const PoseGuess& predicted, TrackerState& state, StateEstimate& estimate) const
{
  health_monitor_.gate(predicted, state.trust, estimate);
  const RegistrationResult& registration = *estimate.registration;
  const Rigid& local_T_body = registration.target_T_source;
  const Eigen::Vector3d up = upInBody(state.map_T_local() * local_T_body);
  MeasurementCorrelation& correlation = state.measurement_correlation;
  correlation.add(estimate.stamp, local_T_body.translation);
  SharedAttitudeNoise& shared = state.shared_attitude_noise;
  shared.add(registration, up, state.local_map.oldest(), correlation.travel());
  // Errors of the attitude stay the same on the length of the map.
  const Matrix6d information = informationWithError(
      registration.information / correlation.registrationsPerTravelOrRest(settings_.slam.tracking.correlation),
      correlation.registrationsPerTravel(shared.length()) * shared.covariance(up));
  FixedLagSmoother& smoother = state.smoother;
  if (smoother.hasAnchor())
    smoother.addRelativePose(smoother.anchor().stamp, state.local_T_anchor.inverse() * local_T_body, information);
  else
    smoother.addPosePrior(state.map_T_local() * local_T_body, information);
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

void Tracker::updateMap(const Seen& seen, const HealthDecision& decision, TrackerState& state, StateEstimate& estimate,
                        StageTimes& times) const
{
  if (estimate.cloud.empty()) return;
  if (decision.begins_map && !state.local_map.empty())
  {
    estimate.map_restarted = true;
    state.local_map.clear();
    state.relocalisation.forget();
    state.trust.contradiction.clear();
    state.trust.last_trusted = estimate.stamp;
    state.resting_since.reset();  // how far it may have moved since then stays in before_window
  }
  const bool sure = state.scans_seen > 1 && estimate.trusted && !estimate.recovered && !decision.contradicted &&
                    state.trust.divergence.level() == Divergence::None &&
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
  if (!state.local_map.empty() && isPositiveDefinite(alignment))
  {
    const NdtMap source(seen.views, settings_.keyframe_cells, Grid::Turned);
    const PoseGuess guess(estimated, alignment);
    const RegistrationResult fine = align(state.local_map.ndt(), source, guess, settings_.registration.fine);
    if (fine.trustworthy())
    {
      local_T_body = fine.target_T_source;
      alignment = inverse(fine.information + inverse(alignment));
    }
  }
  const Matrix6d creep = state.local_map.add(seen.views, local_T_body, alignment);
  if (state.smoother.hasAnchor())
    state.smoother.loosenAnchor(movedTo(state.local_T_anchor, creep));
  else
    state.before_window += creep;
  estimate.keyframe = Keyframe{estimate.stamp, map_T_local * local_T_body, estimate.cloud};
  if (settings_.slam.tracking.relative && !state.smoother.hasAnchor()) state.anchorAt(estimated);
}

TrackerState Tracker::changeImu(TrackerState state, const ImuChange& change) const
{
  const Rigid local_T_body = state.map_T_local().inverse() * state.smoother.newestBody();
  const bool anchored = state.smoother.hasAnchor();
  const NavEstimate start = continuedBy(change, state.newest(), state.smoother.body_T_imu());
  state.smoother = windowFrom(start, change.imu, settings_.smoother);
  if (anchored) state.anchorAt(local_T_body);
  state.relocalisation.changeBias(start.state.bias);
  return state;
}
}  // namespace scanloom
