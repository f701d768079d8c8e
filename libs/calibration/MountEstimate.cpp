#include "calibration/MountEstimate.h"

#include "calibration/MountFit.h"

#include <cstddef>
#include <limits>

namespace scanloom
{
namespace
{
constexpr std::size_t kFewestStations = 10;
constexpr double kLeastShared = 0.1, kMostShareLost = 0.02;
constexpr int kRounds = 15;
constexpr double kSettled = 5e-4;        // m, a round's correction
constexpr double kNearlySettled = 2e-3;  // m: the last round's, where cells come and go at the limit of thickness

constexpr MountLevel kCoarse{2.0, 0.2, 1}, kMiddle{1.0, 0.4, 1};
// Each lidar sees the near side of bushes and crowns: cells full of leaves pull by 1 cm and 0.1 deg in a dense stand.
// Of cells of 2 or 3 points the covariance is assumed, and thin enough.
constexpr MountLevel kFine{1.0, 1.0, std::numeric_limits<std::size_t>::max(), 2, 0.1};

std::vector<Vector6d> twistsOf(const std::vector<Station>& stations)
{
  std::vector<Vector6d> twists;
  for (const Station& station : stations) twists.push_back(station.twist);
  return twists;
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

  /** Whether the mount changes no more. */
  bool improve(Mount& mount) const
  {
    double length = 0;
    for (int round = 0; round < kRounds; ++round)
    {
      const StationCells lidar = cellsOfLidar(stations_, mount, trajectory_, level_);
      std::vector<Neighbourhoods> pairs = stationPairs(reference_, lidar);
      const MountMinimum minimum = minimiseMount(pairs, twists_, clock_, level_.d2);
      mount = moved(mount, minimum.correction);
      length = lengthOf(minimum.correction);
      if (length < kSettled) break;
    }
    return length < kNearlySettled;
  }

  /** In metres. */
  Matrix7d covarianceOf(const Mount& mount, double surface_distance) const
  {
    const StationCells lidar = cellsOfLidar(stations_, mount, trajectory_, level_);
    std::vector<Neighbourhoods> pairs = stationPairs(reference_, lidar);
    const Matrix7d hessian = hessianOf(pairs, twists_, {}, level_.d2);
    const MountEquations equations = mountEquations(pairs, twists_, {}, level_.d2);
    return mountCovariance(hessian, equations.gradients, clock_, mount.body_T_sensor.translation, surface_distance);
  }

 private:
  const std::vector<Station>& stations_;
  const Trajectory& trajectory_;
  MountLevel level_;
  Clock clock_;
  std::vector<Vector6d> twists_;
  std::vector<NdtMap> reference_;
};
}  // namespace

MountEstimate estimateMount(const std::vector<Station>& stations, const Mount& given, const Mount& start,
                            const Trajectory& trajectory, Clock clock)
{
  MountEstimate estimate;
  estimate.mount = given;
  estimate.stations = stations.size();
  if (stations.size() < kFewestStations) return estimate;

  Mount mount = start;
  for (const MountLevel& level : {kCoarse, kMiddle}) LevelOfDrive(stations, trajectory, level, clock).improve(mount);
  const LevelOfDrive fine(stations, trajectory, kFine, clock);
  const bool settled = fine.improve(mount);
  const MountFit before = mountFit(stations, given, trajectory), after = mountFit(stations, mount, trajectory);
  estimate.shared_before = before.shared, estimate.distance_before = before.distance;
  estimate.shared_after = after.shared, estimate.distance_after = after.distance;

  estimate.outcome = MountOutcome::NothingShared;
  if (after.shared < kLeastShared) return estimate;
  estimate.outcome = MountOutcome::Unstable;
  if (!settled || after.shared < before.shared - kMostShareLost) return estimate;
  const Matrix7d covariance = fine.covarianceOf(mount, after.distance);
  estimate.open = openDirections(covariance, kOpenLidar);
  estimate.outcome = estimate.open.empty() ? MountOutcome::Estimated : MountOutcome::Open;
  estimate.mount = keepingOpen(given, mount, estimate.open);
  const Vector7d scale = mountStepOfMetres();
  estimate.covariance = scale.asDiagonal() * covariance * scale.asDiagonal();
  return estimate;
}
}  // namespace scanloom
