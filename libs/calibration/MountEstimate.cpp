#include "calibration/MountEstimate.h"

#include "calibration/internal/MountFit.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace scanloom
{
namespace
{
constexpr std::size_t kFewestStations = 10;
constexpr double kLeastShared = 0.1, kMostShareLost = 0.02;
// The largest surfaceDistance of a right pose: that many times distanceWithinReference (1.1 to 1.25 were measured), and
// 2 cm more, because flat walls are within millimetres of themselves.
constexpr double kFarthestApart = 1.6, kAlwaysAllowed = 0.02;  // a factor; m
constexpr int kRounds = 15;
constexpr double kFarthest = 1;      // m, from the start: so far off a level finds nothing any more
constexpr double kNextLevel = 1e-2;  // m, a round's correction: enough for the next level
constexpr double kSettled = 5e-4;
constexpr double kNearlySettled = 2e-3;  // m: the last round's, where cells come and go at the limit of thickness

constexpr MountLevel kCoarse{2.0, 0.2}, kMiddle{1.0, 0.4};

std::vector<Vector6d> twistsOf(const std::vector<Station>& stations)
{
  std::vector<Vector6d> twists;
  for (const Station& station : stations) twists.push_back(station.twist);
  return twists;
}

/** Root mean square, m/s. */
double speedOf(const std::vector<Vector6d>& twists)
{
  double sum = 0;
  for (const Vector6d& twist : twists) sum += twist.head<3>().squaredNorm();
  return std::sqrt(sum / static_cast<double>(twists.size()));
}

Mount moved(const Mount& mount, const MountCorrection& correction)
{
  return {correction.pose * mount.body_T_sensor, mount.clock_offset + correction.clock};
}

double lengthOf(const MountCorrection& correction)
{
  Vector7d step;
  step << boxMinus(correction.pose, Rigid::identity()), correction.clock;
  return step.cwiseQuotient(mountStepOfMetres()).norm();
}

/** What a level does from one mount to a better one. */
class LevelOfDrive
{
 public:
  LevelOfDrive(const std::vector<Station>& stations, const Trajectory& trajectory, const MountLevel& level, Clock clock)
    : stations_(stations),
      trajectory_(trajectory),
      level_(level),
      clock_(clock),
      twists_(twistsOf(stations)),
      reference_(mapsOfReference(stations, level))
  {
  }

  /** Until a round corrects less than `enough` (m): the last round's correction. */
  double improve(Mount& mount, double enough) const
  {
    const Eigen::Vector3d start = mount.body_T_sensor.translation;
    double length = 0;
    for (int round = 0; round < kRounds; ++round)
    {
      const StationCells lidar = cellsOfLidar(stations_, mount, trajectory_, level_);
      std::vector<CellCorrespondences> pairs = stationPairs(reference_, lidar);
      const MountMinimum minimum = minimiseMount(pairs, twists_, clock_, level_.d2);
      mount = moved(mount, minimum.correction);
      length = lengthOf(minimum.correction);
      if (length < enough || (mount.body_T_sensor.translation - start).norm() > kFarthest) break;
    }
    return length;
  }

  /** In metres. */
  Matrix7d covarianceOf(const Mount& mount, double clock_deviation, double surface_distance) const
  {
    const Curvature at = curvatureAt(mount);
    const double common = commonOffset(surface_distance, stations_.front().stems);
    // What moves the points of all stations alike may be an error of the clock as well, at the body's speed.
    const double deviation = clock_deviation == 0 ? 0 : std::hypot(clock_deviation, common / speedOf(twists_));
    return mountCovariance(at.hessian, at.gradients, deviation, mount.body_T_sensor.translation, common);
  }

  /** In s. */
  double clockDeviation(const Mount& mount) const
  {
    const Curvature at = curvatureAt(mount);
    return std::sqrt(sandwichOfMount(at.hessian, at.gradients, clock_)(6, 6));
  }

 private:
  struct Curvature
  {
    Matrix7d hessian;
    std::vector<Vector7d> gradients;
  };

  Curvature curvatureAt(const Mount& mount) const
  {
    const StationCells lidar = cellsOfLidar(stations_, mount, trajectory_, level_);
    std::vector<CellCorrespondences> pairs = stationPairs(reference_, lidar);
    const Matrix7d hessian = hessianOf(pairs, twists_, {}, level_.d2);
    return {hessian, mountEquations(pairs, twists_, {}, level_.d2).gradients};
  }

  const std::vector<Station>& stations_;
  const Trajectory& trajectory_;
  MountLevel level_;
  Clock clock_;
  std::vector<Vector6d> twists_;
  std::vector<NdtMap> reference_;
};

/** Near the last level's mount, with the final clock. */
struct Approach
{
  Mount mount;
  double clock_deviation = 0;  // s
  bool settled = true;
};

/** A station's twist is that of its own scan. Among scans with other twists the clock is not seen. */
MountLevel ofOwnScan(MountLevel level)
{
  level.scans = 1;
  return level;
}

Approach approachFrom(const Mount& start, const std::vector<Station>& stations, const Trajectory& trajectory,
                      Clock clock)
{
  Approach approach{start};
  for (const MountLevel& level : {kCoarse, kMiddle})
    LevelOfDrive(stations, trajectory, clock == Clock::Kept ? level : ofOwnScan(level), clock)
        .improve(approach.mount, kNextLevel);
  if (clock == Clock::Kept) return approach;
  const LevelOfDrive own(stations, trajectory, ofOwnScan(kFinestLevel), clock);
  approach.settled = own.improve(approach.mount, kSettled) < kNearlySettled;
  approach.clock_deviation = own.clockDeviation(approach.mount);
  return approach;
}
}  // namespace

MountEstimate told(MountEstimate estimate, const Mount& mount, const Matrix7d& covariance, const Mount& given)
{
  static_cast<ToldMount&>(estimate) = toldMount(given, mount, covariance, kOpenLidar);
  estimate.outcome = estimate.open.empty() ? MountOutcome::Estimated : MountOutcome::Open;
  return estimate;
}

MountEstimate estimateMount(const std::vector<Station>& stations, const Mount& given, const MountStart& start,
                            const Trajectory& trajectory, Clock clock, const RotationByImus& imus)
{
  MountEstimate estimate;
  estimate.mount = given;
  estimate.stations = stations.size();
  if (stations.size() < kFewestStations) return estimate;

  const Approach approach = approachFrom(start.mount, stations, trajectory, clock);
  Mount mount = approach.mount;
  const LevelOfDrive fine(stations, trajectory, kFinestLevel, Clock::Kept);
  const bool settled = fine.improve(mount, kSettled) < kNearlySettled && approach.settled;
  const MountFit before = mountFit(stations, given, trajectory), after = mountFit(stations, mount, trajectory);
  estimate.shared_before = before.shared, estimate.distance_before = before.distance;
  estimate.shared_after = after.shared, estimate.distance_after = after.distance;
  estimate.distance_of_reference = distanceWithinReference(stations);

  estimate.outcome = MountOutcome::NothingShared;
  if (after.shared < kLeastShared) return estimate;
  estimate.outcome = MountOutcome::Unstable;
  const bool fits = after.shared >= before.shared - kMostShareLost &&
                    after.distance < kFarthestApart * estimate.distance_of_reference + kAlwaysAllowed;
  if (!settled || !fits) return estimate;
  estimate.outcome = MountOutcome::Contradicted;
  if (contradicts(imus, mount.body_T_sensor.rotation)) return estimate;
  estimate =
      told(std::move(estimate), mount, fine.covarianceOf(mount, approach.clock_deviation, after.distance), given);
  const bool ambiguous = start.rival && fitsAsWell(mountFit(stations, *start.rival, trajectory), after);
  return ambiguous ? doubted(std::move(estimate), *start.rival, given) : estimate;
}

MountEstimate doubted(MountEstimate estimate, const Mount& by, const Mount& given)
{
  const Vector7d to_metres = mountStepOfMetres().cwiseInverse(), between = changeInMetres(estimate.mount, by);
  const Matrix7d covariance = to_metres.asDiagonal() * estimate.covariance * to_metres.asDiagonal();
  const Mount mount = estimate.mount;
  return told(std::move(estimate), mount, covariance + between * between.transpose(), given);
}
}  // namespace scanloom
