#include "estimation/slam/internal/Tracker.h"

#include "base/core/Decompositions.h"
#include "estimation/graph/PosePriorFactor.h"
#include "estimation/ndt/FittedConstants.h"
#include "estimation/ndt/ForestCorrections.h"
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
Matrix6d errorSinceStart(const Rigid& map_T_body, const SmootherWindow& window)
{
  const Matrix6d of_imu = window.smoother.newestCovariance().topLeftCorner<6, 6>();
  return movedTo(window.smoother.body_T_imu().inverse(), of_imu) + movedTo(map_T_body, window.before);
}

/** Covariance of the pose relative to the first one, from what all registrations err alike: structure that is seen from
 * one side shortens the way, and what is seen from nearer than the map saw it lifts it. */
Matrix6d scaleError(const Rigid& map_T_body)
{
  const Eigen::Vector3d way = map_T_body.rotation.conjugate() * map_T_body.translation;
  const Eigen::Vector3d up = upInBody(map_T_body) * way.norm();
  Matrix6d covariance = Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>() =
      fitted::kScaleError * fitted::kScaleError * (way * way.transpose() + up * up.transpose());
  return covariance;
}

Trajectory motionBetween(const SmootherWindow& before, const SmootherWindow& after,
                         const std::vector<ImuSample>& samples)
{
  return posesBetween(before.smoother.newest(), after.smoother.newest(), samples,
                      after.smoother.body_T_imu().inverse());
}

LastGood goodAt(Timestamp stamp, const BodyEstimate& body, const Matrix6d& since_start)
{
  return {stamp, body.velocity, movedTo(body.map_T_body.inverse(), since_start)};
}

/** m, by which the body moved because the local map did: gravity corrects the attitude of the anchor, and with it all
 * that hangs on it. 0 where the body was found again. */
double shiftByMap(const SmootherWindow& before, const Continued& scan)
{
  if (scan.recovered || scan.begins_map) return 0;
  const Rigid& map_T_body = scan.body.map_T_body;
  const Rigid local_T_body = scan.body.window.map_T_local().inverse() * map_T_body;
  return ((before.map_T_local() * local_T_body).translation - map_T_body.translation).norm();
}

/** Whether the scan's pose is certain enough for a keyframe, which all later scans are registered to. */
bool isSure(const DeskewedScan& seen, const Continued& scan)
{
  return seen.in_a_row > 1 && scan.registration.trusted && !scan.recovered && !scan.assessment.contradicted &&
         scan.trust.divergence.level() == Divergence::None && scan.registration.result->outcome == Outcome::Converged;
}

/** What the next scan needs of this one. */
TrackerState stateAfter(const DeskewedScan& seen, const Continued& scan, UpdatedMap map,
                        const SharedAttitudeNoise& shared_noise, const LastGood& last_good)
{
  TrackerState state{std::move(map.window), std::move(map.local_map), scan.trust,    scan.relocalisation,
                     shared_noise,          scan.resting_since,       seen.in_a_row, last_good};
  if (!map.restarted) return state;
  state.relocalisation.forget();
  state.trust.contradiction.clear();
  state.trust.last_trusted = seen.stamp;
  state.resting_since.reset();  // how far it may have moved since then stays in SmootherWindow::before
  return state;
}

/** Without the cloud. */
StateEstimate estimateOf(const DeskewedScan& seen, const Prediction& predicted, const Continued& scan,
                         const UpdatedMap& map, const Matrix6d& since_start, const Trajectory& motion)
{
  StateEstimate estimate;
  estimate.stamp = seen.stamp;
  estimate.map_T_body = scan.body.map_T_body;
  estimate.covariance = scan.body.covariance;
  estimate.in_map = map.local_map.isInPriorMap();
  estimate.since_start = since_start;
  // In the map of an earlier drive the way since that one's start is part of the map.
  estimate.since_start +=
      estimate.in_map ? map.local_map.covarianceOfPrior(scan.body.map_T_body) : scaleError(scan.body.map_T_body);
  estimate.correction = boxMinus(scan.body.map_T_body, predicted.map_T_body);
  estimate.velocity = scan.body.velocity;
  estimate.imu_bias = scan.body.window.smoother.newest().bias;
  estimate.health = scan.assessment.health;
  estimate.scan_complete = seen.complete;
  estimate.registration = scan.registration.result;
  estimate.mahalanobis = scan.registration.mahalanobis;
  estimate.trusted = scan.registration.trusted;
  estimate.recovered = scan.recovered;
  estimate.map_restarted = map.restarted;
  estimate.keyframe = map.keyframe;
  estimate.keyframe_covariance = map.keyframe_covariance;
  estimate.since_last = motion;
  return estimate;
}
}  // namespace

Tracker::Tracker(const SlamSettings& settings, const std::vector<MountedLidar>& lidars)
  : settings_(settings),
    health_monitor_(settings),
    body_T_lidar_(posesOf(lidars)),
    corrections_(cellCorrections(settings.slam.forest))
{
}

TrackerState Tracker::begin(const NavEstimate& start, const MountedImu& imu) const
{
  TrackerState state{windowFrom(start, imu, settings_.smoother), LocalMap(settings_.local_map, settings_.map_cells)};
  state.trust.last_trusted = start.state.stamp;
  state.last_good = {start.state.stamp, start.state.velocity};
  return state;
}

TrackedScan Tracker::step(TrackerState before, Scan scan, const std::vector<ImuSample>& samples) const
{
  const Prediction predicted = predict(before.window, samples);
  DeskewedScan seen = deskewToEnd(std::move(scan), before, samples);
  const GatedRegistration registered = registerToMap(before, seen, predicted);
  const Measurement measured = weigh(registered, before, predicted, seen.stamp);
  const Timed<BodyEstimate> smoothed = smooth(measured, predicted);
  const Continued continued = health_monitor_.assess(before, seen, registered, measured, smoothed.value);
  UpdatedMap map = updateMap(std::move(before.local_map), seen, continued);

  const Trajectory motion = motionBetween(before.window, smoothed.value.window, samples);
  const Matrix6d since_start = errorSinceStart(continued.body.map_T_body, map.window);
  const LastGood last_good = continued.trust.lost ? before.last_good : goodAt(seen.stamp, continued.body, since_start);
  const StageRuns times =
      predicted.times + seen.times + registered.times + smoothed.times + continued.times + map.times;
  StateEstimate estimate = estimateOf(seen, predicted, continued, map, since_start, motion);
  estimate.map_shift = shiftByMap(before.window, continued);
  if (estimate.mapJumped() && estimate.health == Health::Ok) estimate.health = Health::Degenerate;
  estimate.imu = samples.back();
  estimate.body_T_imu = before.window.smoother.body_T_imu();
  TrackerState after = stateAfter(seen, continued, std::move(map), measured.shared_noise, last_good);
  estimate.cloud = std::move(seen.cloud);
  return {std::move(after), std::move(estimate), times};
}

/** The newest state becomes the one at the end of the samples, as the IMU predicts it. */
Prediction Tracker::predict(const SmootherWindow& before, const std::vector<ImuSample>& samples) const
{
  StageRuns times;
  SmootherWindow window = before;
  FixedLagSmoother& smoother = window.smoother;
  smoother.addState(
      times.measure("preintegration", [&] { return preintegrate(samples, smoother.newest().bias, smoother.noise()); }));
  const Matrix6d covariance = times.measure("smoother", [&] { return smoother.newestBodyCovariance(); });
  const Rigid map_T_body = smoother.newestBody();
  return {std::move(window), map_T_body, covariance, times};
}

/** Moved to where each point is seen from the body at the end of the scan. */
DeskewedScan Tracker::deskewToEnd(Scan scan, const TrackerState& before, const std::vector<ImuSample>& samples) const
{
  StageRuns times;
  const Timestamp end = scan.end();
  const bool complete = scan.complete();
  const auto period = static_cast<std::int32_t>(scan.period.count());
  PointCloud cloud = times.measure("deskew",
                                   [&]
                                   {
                                     const NavState& from = before.window.smoother.newest();
                                     const Rigid imu_T_body = before.window.smoother.body_T_imu().inverse();
                                     const Rigid end_T_map =
                                         (predictAt(from, samples, {end}).front().map_T_imu * imu_T_body).inverse();
                                     std::vector<Rigid> end_T_column;
                                     for (const Rigid& map_T_body : bodyAtColumns(scan, from, samples, imu_T_body))
                                       end_T_column.push_back(end_T_map * map_T_body);
                                     PointCloud moved = deskew(std::move(scan), end_T_column);
                                     for (std::int32_t& t : moved.t) t -= period;  // it counts from the end now
                                     return moved;
                                   });
  std::vector<View> views = times.measure("deskew", [&] { return viewsOf(cloud, body_T_lidar_, corrections_); });
  const int in_a_row = cloud.empty() ? 0 : before.scans_seen + 1;
  return {end, complete, std::move(cloud), std::move(views), in_a_row, times};
}

GatedRegistration Tracker::registerToMap(const TrackerState& before, const DeskewedScan& seen,
                                         const Prediction& predicted) const
{
  if (before.local_map.empty() || seen.cloud.empty() || !isPositiveDefinite(predicted.covariance)) return {};
  const PoseGuess guess(predicted.window.map_T_local().inverse() * predicted.map_T_body, predicted.covariance);
  return health_monitor_.gated(registerScan(before, seen.views, guess), guess, before);
}

Timed<RegistrationResult> Tracker::registerScan(const TrackerState& before, const std::vector<View>& views,
                                                const PoseGuess& guess) const
{
  const NdtMap& map = before.local_map.ndt();
  const ScanRegistrationOptions& options = settings_.registration;
  // The effort is the search's: the prediction of an IMU that lost the body is worth little.
  if (before.trust.lost) return registerFinely(map, views, guess.target_T_source, withLimitedEffort(options));
  const std::optional<LastSeen>& last = before.relocalisation.lastSeen();
  return registerTwice(map, views, guess, last ? std::optional(last->score) : std::nullopt, options);
}

/** The smoother's robust loss follows a registration that contradicts the IMU only slowly; such a one is not trusted.
 */
Measurement Tracker::weigh(const GatedRegistration& registered, const TrackerState& before, const Prediction& predicted,
                           Timestamp stamp) const
{
  Measurement measured{predicted.window, before.shared_attitude_noise, before.trust.contradiction};
  if (!registered.result || registered.result->outcome == Outcome::LowOverlap) return measured;
  if (before.trust.imu_silent)
    measured.contradiction.clear();
  else
    measured.contradiction.add(stamp, registered.mahalanobis);
  const RegistrationResult& seen = *registered.result;
  const Rigid& local_T_body = seen.target_T_source;
  SmootherWindow& window = measured.window;
  const Rigid map_T_local = window.map_T_local();
  const Eigen::Vector3d up = upInBody(map_T_local * local_T_body);
  window.correlation.add(stamp, local_T_body.translation);
  measured.shared_noise.add(seen, up, before.local_map.oldest(), window.correlation.travel());
  // Errors of the attitude stay the same on the length of the map.
  const Matrix6d information = informationWithError(
      seen.information / window.correlation.registrationsPerTravelOrRest(fitted::kCorrelationLength),
      window.correlation.registrationsPerTravel(measured.shared_noise.length()) * measured.shared_noise.covariance(up));
  if (window.smoother.hasAnchor())
    window.smoother.addRelativePose(window.smoother.anchor().stamp, window.local_T_anchor.inverse() * local_T_body,
                                    information);
  else
    window.smoother.addPosePrior(map_T_local * local_T_body, information);
  return measured;
}

Timed<BodyEstimate> Tracker::smooth(const Measurement& measured, const Prediction& predicted) const
{
  StageRuns times;
  SmootherWindow window = measured.window;
  const NavState newest = times.measure("smoother", [&] { return window.smoother.optimise(); });
  const Rigid map_T_body = window.smoother.newestBody();
  const Matrix6d covariance = window.smoother.bodyCovarianceAfter(predicted.covariance);
  return {{std::move(window), map_T_body, covariance, newest.velocity}, times};
}

UpdatedMap Tracker::updateMap(LocalMap local_map, const DeskewedScan& seen, const Continued& scan) const
{
  UpdatedMap map{std::move(local_map), scan.body.window, std::nullopt, Matrix6d::Zero(), false, {}};
  if (seen.cloud.empty()) return map;
  map.restarted = scan.begins_map && !map.local_map.empty();
  if (map.restarted) map.local_map.clear();
  const Rigid local_T_body = map.window.map_T_local().inverse() * scan.body.map_T_body;
  map.local_map.moveTo(local_T_body.translation);
  const bool is_wanted = map.local_map.empty() || (isSure(seen, scan) && map.local_map.wants(local_T_body));
  if (!is_wanted) return map;
  StageRuns times;
  map = times.measure("keyframe", [&] { return withKeyframe(std::move(map), seen, local_T_body); });
  map.times = times;
  return map;
}

UpdatedMap Tracker::withKeyframe(UpdatedMap map, const DeskewedScan& seen, const Rigid& local_T_body) const
{
  const Rigid map_T_local = map.window.map_T_local();
  const KeyframePose pose = alignFinely(map, seen.views, local_T_body);
  const Matrix6d drift = map.local_map.add(seen.views, pose.local_T_body, pose.covariance);
  if (map.window.smoother.hasAnchor())
    map.window.smoother.loosenAnchor(movedTo(map.window.local_T_anchor, drift));
  else
    map.window.before += drift;
  map.keyframe_covariance = pose.covariance;
  map.keyframe = Keyframe{seen.stamp, map_T_local * pose.local_T_body, seen.cloud};
  // The map of an earlier drive does not move: registrations in it are poses, not relative to a keyframe. Nor does one
  // without an IMU: an assumed gravity would tilt it when a car brakes.
  const bool is_relative = settings_.slam.relative && !map.local_map.isInPriorMap() && !map.window.imu_is_assumed;
  if (is_relative && !map.window.smoother.hasAnchor()) map.window.anchorAt(local_T_body);
  return map;
}

/** Registers the scan again with finer cells, within the covariance of the estimate. */
KeyframePose Tracker::alignFinely(const UpdatedMap& map, const std::vector<View>& views,
                                  const Rigid& local_T_body) const
{
  const KeyframePose estimated{local_T_body, map.window.smoother.newestBodyCovariance()};
  if (map.local_map.empty() || !isPositiveDefinite(estimated.covariance)) return estimated;
  const NdtMap source(views, settings_.keyframe_cells, Grid::Turned);
  const PoseGuess guess(local_T_body, estimated.covariance);
  const RegistrationResult fine = align(map.local_map.ndt(), source, guess, settings_.registration.fine);
  if (!fine.trustworthy()) return estimated;
  return {fine.target_T_source, inverse(fine.information + inverse(estimated.covariance))};
}

TrackerState Tracker::enterMap(const TrackerState& before, const MapEntry& entry) const
{
  const MountedImu imu = before.window.imu();
  const NavEstimate start = inFrame(entry.map_T_drive, entry.covariance, before.window.newest(), imu);
  const Timestamp stamp = start.state.stamp;
  const Rigid map_T_body = start.state.map_T_imu * imu.body_T_imu.inverse();
  TrackerState state{windowFrom(start, imu, settings_.smoother),
                     LocalMap(settings_.local_map, settings_.map_cells, entry.map)};
  state.local_map.moveTo(map_T_body.translation);
  state.trust.last_trusted = stamp;
  state.trust.initialising_until = before.trust.initialising_until;
  state.scans_seen = before.scans_seen;
  state.last_good = {stamp, start.state.velocity, movedTo(map_T_body.inverse(), entry.covariance)};
  return state;
}

TrackerState Tracker::changeImu(TrackerState state, const ImuChange& change) const
{
  const SmootherWindow& before = state.window;
  const Rigid map_T_local = before.map_T_local();
  const NavEstimate start = continuedBy(change, before.newest(), before.smoother.body_T_imu());
  SmootherWindow window = windowFrom(start, change.imu, settings_.smoother);
  window.map_T_local_without_anchor = map_T_local;
  window.correlation = before.correlation;
  window.before = before.before;
  if (before.smoother.hasAnchor() && !change.imu.assumed)
    window.anchorAt(map_T_local.inverse() * before.smoother.newestBody());
  state.window = std::move(window);
  state.relocalisation.changeBias(start.state.bias);
  return state;
}
}  // namespace scanloom
