#include "calibration/ExtrinsicsEstimate.h"

#include "calibration/internal/ExtrinsicsFit.h"

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

constexpr ExtrinsicsLevel kCoarse{2.0, 0.2}, kMiddle{1.0, 0.4};

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

Extrinsics moved(const Extrinsics& extrinsics, const ExtrinsicsCorrection& correction)
{
  return {correction.pose * extrinsics.body_T_sensor, extrinsics.clock_offset + correction.clock};
}

double lengthOf(const ExtrinsicsCorrection& correction)
{
  Vector7d step;
  step << boxMinus(correction.pose, Rigid::identity()), correction.clock;
  return step.cwiseQuotient(extrinsicsStepOfMetres()).norm();
}

/** What a level does from extrinsics to better ones. */
class LevelOfDrive
{
 public:
  LevelOfDrive(const std::vector<Station>& stations, const Trajectory& trajectory, const ExtrinsicsLevel& level,
               Clock clock)
    : stations_(stations),
      trajectory_(trajectory),
      level_(level),
      clock_(clock),
      twists_(twistsOf(stations)),
      reference_(mapsOfReference(stations, level))
  {
  }

  /** Until a round corrects less than `enough` (m): the last round's correction. */
  double improve(Extrinsics& extrinsics, double enough) const
  {
    const Eigen::Vector3d start = extrinsics.body_T_sensor.translation;
    double length = 0;
    for (int round = 0; round < kRounds; ++round)
    {
      const StationCells lidar = cellsOfLidar(stations_, extrinsics, trajectory_, level_);
      std::vector<CellCorrespondences> pairs = stationPairs(reference_, lidar);
      const ExtrinsicsMinimum minimum = minimiseExtrinsics(pairs, twists_, clock_, level_.d2);
      extrinsics = moved(extrinsics, minimum.correction);
      length = lengthOf(minimum.correction);
      if (length < enough || (extrinsics.body_T_sensor.translation - start).norm() > kFarthest) break;
    }
    return length;
  }

  /** In metres. */
  Matrix7d covarianceOf(const Extrinsics& extrinsics, double clock_deviation, double surface_distance) const
  {
    const Curvature at = curvatureAt(extrinsics);
    const double common = commonOffset(surface_distance, stations_.front().stems);
    // What moves the points of all stations alike may be an error of the clock as well, at the body's speed.
    const double deviation = clock_deviation == 0 ? 0 : std::hypot(clock_deviation, common / speedOf(twists_));
    return extrinsicsCovariance(at.hessian, at.gradients, deviation, extrinsics.body_T_sensor.translation, common);
  }

  /** In s. */
  double clockDeviation(const Extrinsics& extrinsics) const
  {
    const Curvature at = curvatureAt(extrinsics);
    return std::sqrt(sandwichOfExtrinsics(at.hessian, at.gradients, clock_)(6, 6));
  }

 private:
  struct Curvature
  {
    Matrix7d hessian;
    std::vector<Vector7d> gradients;
  };

  Curvature curvatureAt(const Extrinsics& extrinsics) const
  {
    const StationCells lidar = cellsOfLidar(stations_, extrinsics, trajectory_, level_);
    std::vector<CellCorrespondences> pairs = stationPairs(reference_, lidar);
    const Matrix7d hessian = hessianOf(pairs, twists_, {}, level_.d2);
    return {hessian, extrinsicsEquations(pairs, twists_, {}, level_.d2).gradients};
  }

  const std::vector<Station>& stations_;
  const Trajectory& trajectory_;
  ExtrinsicsLevel level_;
  Clock clock_;
  std::vector<Vector6d> twists_;
  std::vector<NdtMap> reference_;
};

/** Near the last level's extrinsics, with the final clock. */
struct Approach
{
  Extrinsics extrinsics;
  double clock_deviation = 0;  // s
  bool settled = true;
};

/** A station's twist is that of its own scan. Among scans with other twists the clock is not seen. */
ExtrinsicsLevel ofOwnScan(ExtrinsicsLevel level)
{
  level.scans = 1;
  return level;
}

Approach approachFrom(const Extrinsics& start, const std::vector<Station>& stations, const Trajectory& trajectory,
                      Clock clock)
{
  Approach approach{start};
  for (const ExtrinsicsLevel& level : {kCoarse, kMiddle})
    LevelOfDrive(stations, trajectory, clock == Clock::Kept ? level : ofOwnScan(level), clock)
        .improve(approach.extrinsics, kNextLevel);
  if (clock == Clock::Kept) return approach;
  const LevelOfDrive own(stations, trajectory, ofOwnScan(kFinestLevel), clock);
  approach.settled = own.improve(approach.extrinsics, kSettled) < kNearlySettled;
  approach.clock_deviation = own.clockDeviation(approach.extrinsics);
  return approach;
}
}  // namespace

ExtrinsicsEstimate observable(ExtrinsicsEstimate estimate, const Extrinsics& extrinsics, const Matrix7d& covariance,
                              const Extrinsics& given)
{
  static_cast<ObservableExtrinsics&>(estimate) = observableExtrinsics(given, extrinsics, covariance, kOpenLidar);
  estimate.outcome = estimate.open.empty() ? ExtrinsicsOutcome::Estimated : ExtrinsicsOutcome::Open;
  return estimate;
}

ExtrinsicsEstimate estimateExtrinsics(const std::vector<Station>& stations, const Extrinsics& given,
                                      const ExtrinsicsStart& start, const Trajectory& trajectory, Clock clock,
                                      const RotationByImus& imus)
{
  ExtrinsicsEstimate estimate;
  estimate.extrinsics = given;
  estimate.stations = stations.size();
  if (stations.size() < kFewestStations) return estimate;

  const Approach approach = approachFrom(start.extrinsics, stations, trajectory, clock);
  Extrinsics extrinsics = approach.extrinsics;
  const LevelOfDrive fine(stations, trajectory, kFinestLevel, Clock::Kept);
  const bool settled = fine.improve(extrinsics, kSettled) < kNearlySettled && approach.settled;
  const ExtrinsicsFit before = extrinsicsFit(stations, given, trajectory),
                      after = extrinsicsFit(stations, extrinsics, trajectory);
  estimate.shared_before = before.shared, estimate.distance_before = before.distance;
  estimate.shared_after = after.shared, estimate.distance_after = after.distance;
  estimate.distance_of_reference = distanceWithinReference(stations);

  estimate.outcome = ExtrinsicsOutcome::NothingShared;
  if (after.shared < kLeastShared) return estimate;
  estimate.outcome = ExtrinsicsOutcome::Unstable;
  const bool fits = after.shared >= before.shared - kMostShareLost &&
                    after.distance < kFarthestApart * estimate.distance_of_reference + kAlwaysAllowed;
  if (!settled || !fits) return estimate;
  estimate.outcome = ExtrinsicsOutcome::Contradicted;
  if (contradicts(imus, extrinsics.body_T_sensor.rotation)) return estimate;
  estimate = observable(std::move(estimate), extrinsics,
                        fine.covarianceOf(extrinsics, approach.clock_deviation, after.distance), given);
  const bool ambiguous = start.rival && fitsAsWell(extrinsicsFit(stations, *start.rival, trajectory), after);
  return ambiguous ? doubted(std::move(estimate), *start.rival, given) : estimate;
}

ExtrinsicsEstimate doubted(ExtrinsicsEstimate estimate, const Extrinsics& by, const Extrinsics& given)
{
  const Vector7d to_metres = extrinsicsStepOfMetres().cwiseInverse(), between = changeInMetres(estimate.extrinsics, by);
  const Matrix7d covariance = to_metres.asDiagonal() * estimate.covariance * to_metres.asDiagonal();
  const Extrinsics extrinsics = estimate.extrinsics;
  return observable(std::move(estimate), extrinsics, covariance + between * between.transpose(), given);
}
}  // namespace scanloom
