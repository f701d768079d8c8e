#include "estimation/slam/internal/HealthMonitor.h"

#include "base/core/Decompositions.h"
#include "estimation/ndt/FittedConstants.h"
#include "estimation/ndt/LidarInformation.h"

#include <utility>

namespace scanloom
{
namespace
{
/**
 * The scan agrees with the map where the IMU says that the body is, but leaves a direction open, along which the body
 * can hardly have moved. A search would only find another place that looks alike.
 */
bool isWhereItIsSaidToBe(const Continued& scan)
{
  const std::optional<RegistrationResult>& seen = scan.registration.result;
  return seen && seen->outcome == Outcome::Degenerate &&
         3 * largestDeviation(scan.body.covariance) < 2;  // m: from there an alignment finds the pose
}

/** No registration was trusted for seconds, though none contradicts the IMU for as long. */
bool isWithoutTrust(const Assessment& assessment)
{
  return assessment.health == Health::Lost && !assessment.contradicted;
}

/** The IMU carries the body on, and nothing contradicts it: through a corridor, for example. */
bool isCarriedOn(const Continued& scan)
{
  return isWithoutTrust(scan.assessment) && isWhereItIsSaidToBe(scan) &&
         scan.registration.mahalanobis < fitted::kUsualDistance;
}

bool isBlind(const Continued& scan) { return isWithoutTrust(scan.assessment) && !isWhereItIsSaidToBe(scan); }

/**
 * Where IMU and lidar err by much, the estimate between both is near neither. A registration beyond the gate counts if
 * it goes on with those before and is far off: an IMU that errs by metres a second has carried the estimate away from
 * all of them. What a lost body sees may be another place in all scans.
 */
TrustHistory compared(TrustHistory trust, const GatedRegistration& registered, const Measurement& measured,
                      const BodyEstimate& body)
{
  if (!registered.usable)
  {
    trust.lidar_track.clear();
    return trust;
  }
  const Rigid local_T_body = body.window.map_T_local().inverse() * body.map_T_body;
  const Rigid& seen = registered.result->target_T_source;
  const Vector6d apart = boxMinus(local_T_body, seen);
  const bool goes_on = !trust.lost && apart.head<3>().norm() > fitted::kFarApart && trust.lidar_track.goesOnTo(seen);
  trust.lidar_track.add(seen);
  if (!registered.trusted && !goes_on) return trust;
  const Matrix6d shared = measured.shared_noise.covariance(upInBody(body.map_T_body));
  trust.divergence.add(apart, body.covariance + registered.result->covariance + shared);
  return trust;
}

/** A lost body is near its prediction, or where the scan fits nearly as well as the last trusted one did. */
bool isUsable(const RegistrationResult& seen, double mahalanobis, const TrackerState& before)
{
  if (!before.trust.lost) return seen.trustworthy();
  const std::optional<LastSeen>& last = before.relocalisation.lastSeen();
  const bool fits = !last || !(seen.score > fitted::kScoreOfPlace * last->score);  // scores are negative
  return seen.outcome == Outcome::Converged && (fits || mahalanobis < fitted::kUsualDistance);
}

DeadReckoning motionWhileLost(const LastGood& last_good, const BodyEstimate& body, Timestamp stamp)
{
  return {body.velocity - last_good.velocity, stamp - last_good.stamp};
}

/** The body was seen in the same map as before it rested, so the rest in between does not count. */
Continued awake(Continued scan, const LastGood& last_good)
{
  scan.resting_since.reset();
  scan.body.window.before = last_good.since_start;
  return scan;
}
}  // namespace

HealthMonitor::HealthMonitor(const SlamSettings& settings)
  : trust_(settings.slam.trust), smoother_(settings.smoother), registration_(settings.registration)
{
}

GatedRegistration HealthMonitor::gated(Timed<RegistrationResult> seen, const PoseGuess& predicted,
                                       const TrackerState& before) const
{
  GatedRegistration gated{std::move(seen.value), 0, false, false, std::move(seen.times)};
  if (gated.result->outcome == Outcome::LowOverlap) return gated;
  gated.mahalanobis = mahalanobisOf(*gated.result, predicted);
  gated.usable = isUsable(*gated.result, gated.mahalanobis, before);
  gated.trusted = gated.usable && gated.mahalanobis <= fitted::kGate;
  return gated;
}

Continued HealthMonitor::assess(const TrackerState& before, const DeskewedScan& seen,
                                const GatedRegistration& registered, const Measurement& measured,
                                const BodyEstimate& body) const
{
  TrustHistory trust = before.trust;
  trust.contradiction = measured.contradiction;
  trust = compared(std::move(trust), registered, measured, body);
  Continued scan =
      assessed({body, registered, trust, before.relocalisation, before.resting_since}, seen, before.local_map.empty());
  if (scan.trust.divergence.level() == Divergence::Persistent)
    scan = accordingToLidar(std::move(scan), before, seen.stamp);
  else if (isBlind(scan))
    scan = recovered(std::move(scan), before, seen);

  const Duration without_trust = seen.stamp - scan.trust.last_trusted;
  if (scan.assessment.health == Health::Lost && without_trust > fromSeconds(trust_.lost_after + trust_.restart_after))
    return withoutMap(std::move(scan), before, seen);
  return scan.resting_since ? awake(std::move(scan), before.last_good) : scan;
}

/** The scan with its health, and with what the next scans are assessed by. */
Continued HealthMonitor::assessed(Continued scan, const DeskewedScan& seen, bool map_is_empty) const
{
  const bool opens_map = map_is_empty && !seen.cloud.empty();
  const GatedRegistration& registered = scan.registration;
  scan.assessment = scanloom::assess(seen.stamp, opens_map || registered.trusted, scan.trust, trust_);
  if (isCarriedOn(scan)) scan.assessment.health = Health::Degenerate;
  scan.trust.lost = scan.assessment.health == Health::Lost;
  scan.trust.last_trusted = scan.assessment.last_trusted;
  if (registered.trusted && scan.trust.divergence.level() == Divergence::None)
    scan.relocalisation.remember({registered.result->target_T_source, registered.result->score,
                                  scan.body.window.map_T_local(), scan.body.window.smoother.newest().bias});
  return scan;
}

/** The scan as it is, if the body is not found. */
Continued HealthMonitor::recovered(Continued scan, const TrackerState& before, const DeskewedScan& seen) const
{
  if (before.local_map.empty() || seen.cloud.empty()) return scan;
  const Rigid& map_T_body = scan.body.map_T_body;
  const LostBody lost{
      (scan.body.window.map_T_local().inverse() * map_T_body).rotation,
      map_T_body.rotation.conjugate() * meanForce(motionWhileLost(before.last_good, scan.body, seen.stamp)),
      seen.stamp - scan.trust.last_trusted};
  const Search search =
      scan.relocalisation.search(before.local_map.ndt(), seen.views, lost, withLimitedEffort(registration_));
  scan.relocalisation = search.after;
  scan.times = search.times;
  if (!search.found) return scan;
  scan = begunAgainAt(*search.found, std::move(scan), before.last_good);
  scan.trust.contradiction.clear();
  return assessed(std::move(scan), seen, false);
}

/** An error of the IMU stays in the velocity: without a new window the lidar would pull at it for seconds. */
Continued HealthMonitor::accordingToLidar(Continued scan, const TrackerState& before, Timestamp stamp) const
{
  const RegistrationResult& seen = *scan.registration.result;
  const std::optional<Timestamp>& accepted = scan.trust.lidar_accepted;
  // Where lidar and IMU always contradict each other, InnovationMonitor must see it.
  const bool too_often = accepted && stamp - *accepted < 10s && !scan.trust.imu_silent;
  if (too_often || !scan.relocalisation.lastSeen() || !isPositiveDefinite(seen.covariance)) return scan;
  const FoundBody found{seen, seen.covariance};
  scan = begunAgainAt(found, std::move(scan), before.last_good);
  scan.trust.lidar_accepted = stamp;
  return scan;
}

/**
 * Begins a new window where the body is found. The map frame and the biases are those of the last trusted scan: what
 * the IMU read since then, and registrations that contradicted it, would tilt them.
 */
Continued HealthMonitor::begunAgainAt(const FoundBody& found, Continued scan, const LastGood& last_good) const
{
  const double smear = 0.15;  // m: the scan, of 0.1 s, was deskewed by a motion that may be wrong by 1.5 m/s
  const LastSeen& seen = *scan.relocalisation.lastSeen();
  const MountedImu imu = scan.body.window.imu();
  Matrix6d covariance = found.covariance;
  covariance.diagonal().head<3>().array() += smear * smear;
  const NavEstimate start = foundAt(seen.map_T_local * found.registration.target_T_source, covariance,
                                    scan.body.window.newest(), seen.bias, imu);
  SmootherWindow window = begun(start, imu, seen.map_T_local, last_good.since_start);
  const Rigid map_T_body = window.smoother.newestBody();
  const Matrix6d body_covariance = window.smoother.newestBodyCovariance();
  const Eigen::Vector3d velocity = window.smoother.newest().velocity;
  scan.body = {std::move(window), map_T_body, body_covariance, velocity};
  scan.registration.result = found.registration;
  scan.registration.trusted = scan.recovered = true;
  scan.trust.divergence = {};
  return scan;
}

/**
 * Lost for good: a scan begins a new map. The body moves on as the IMU says, unless that does not know its velocity any
 * more, or cannot be right, or no scan was ever found in the map (the velocity is older than that): then it rests. A
 * scan that was deskewed by an impossible motion begins no map.
 */
Continued HealthMonitor::withoutMap(Continued scan, const TrackerState& before, const DeskewedScan& seen) const
{
  const SmootherWindow& window = scan.body.window;
  const Timestamp last = before.window.smoother.newest().stamp;
  const Eigen::Quaterniond map_R_body = window.smoother.newestBody().rotation;
  scan.begins_map = seen.in_a_row > 1;
  if (scan.resting_since)
  {
    scan.body = resting(scan.body, {map_R_body}, before, seen.stamp - *scan.resting_since);
    return scan;
  }
  const DeadReckoning motion = motionWhileLost(before.last_good, scan.body, seen.stamp);
  const NavEstimate newest = window.newest();
  if (scan.relocalisation.lastSeen() && isPossible(motion) && knowsVelocity(newest))
  {
    if (scan.begins_map) scan.body.window = begun(newest, window.imu(), window.map_T_local(), window.before);
    return scan;
  }
  scan.begins_map = false;
  scan.resting_since = last;
  scan.body = resting(scan.body, levelledByMeanForce(map_R_body, motion), before, seen.stamp - last);
  return scan;
}

/** The body at its place before. How far it may be from there after this `rest` is not for the smoother: it computes
 * with differences of a millimetre. */
BodyEstimate HealthMonitor::resting(const BodyEstimate& body, const Attitude& attitude, const TrackerState& before,
                                    Duration rest) const
{
  const MountedImu imu = body.window.imu();
  const Rigid map_T_body_before = before.window.smoother.newest().map_T_imu * imu.body_T_imu.inverse();
  const Rigid map_T_body{attitude.map_R_body, map_T_body_before.translation};
  const NavEstimate start = atRest(map_T_body, attitude.tilt_sigma, body.window.newest(), imu);
  const double reach = fitted::kMachineSpeed * seconds(rest);
  const auto widened = [&](Matrix6d covariance)
  {
    covariance.diagonal().head<3>().array() += reach * reach;
    return covariance;
  };
  SmootherWindow window = begun(start, imu, body.window.map_T_local(), widened(before.last_good.since_start));
  const Matrix6d covariance = widened(window.smoother.newestBodyCovariance());
  return {std::move(window), map_T_body, covariance, Eigen::Vector3d::Zero()};
}

SmootherWindow HealthMonitor::begun(const NavEstimate& newest, const MountedImu& imu, const Rigid& map_T_local,
                                    const Matrix6d& before) const
{
  SmootherWindow window = windowFrom(newest, imu, smoother_);
  window.map_T_local_without_anchor = map_T_local;
  window.before = before;
  return window;
}
}  // namespace scanloom
