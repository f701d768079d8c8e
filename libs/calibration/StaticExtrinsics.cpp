#include "calibration/StaticExtrinsics.h"

#include "calibration/internal/ExtrinsicsFit.h"
#include "estimation/ndt/LidarInformation.h"
#include "estimation/ndt/Registration.h"

#include <algorithm>
#include <optional>

namespace scanloom
{
namespace
{
constexpr double kLeastSharedAtRest = 0.1, kMostShareLostAtRest = 0.02;
constexpr ExtrinsicsLevel kStartLevels[] = {{2.0, 0.2}, {1.0, 0.4}}, kLastLevel{1.0, 1.0};
constexpr std::size_t kFewestCells = 50;
constexpr int kRoundsAtRest = 6;
constexpr double kSettledAtRest = 1e-3;  // m

/** All poses of a body that does not move are one. */
Trajectory atRest() { return {{Timestamp{-100ms}, {}}, {Timestamp{100ms}, {}}}; }

LidarScan scanOf(const StaticLidar& lidar)
{
  return {Timestamp{}, Duration{0}, lidar.points, std::vector<std::int32_t>(lidar.points.size(), 0)};
}

View viewOf(const StaticLidar& lidar, const Rigid& body_T_sensor)
{
  return movedBy(body_T_sensor, {lidar.points, std::nullopt});
}

/** The only station of a body that does not move. */
class Instant
{
 public:
  Instant(const LidarScan& scan, std::vector<View> known)
    : stations_{{Timestamp{}, {&scan}, std::move(known), Vector6d::Zero()}}
  {
  }

  const std::vector<Station>& stations() const { return stations_; }

  /** Of 1 m: a covered lidar fills few, and few fit anywhere. */
  std::size_t cells() const { return cellsOfLidar(stations_, {}, atRest(), kLastLevel).front().size(); }

  ExtrinsicsFit fitOf(const Extrinsics& extrinsics) const { return extrinsicsFit(stations_, extrinsics, atRest()); }

  Extrinsics improved(Extrinsics extrinsics) const
  {
    for (const ExtrinsicsLevel& level : kStartLevels)
    {
      const std::vector<NdtMap> known = mapsOfReference(stations_, level);
      for (int round = 0; round < kRoundsAtRest; ++round)
      {
        const StationCells own = cellsOfLidar(stations_, extrinsics, atRest(), level);
        std::vector<CellCorrespondences> pairs = stationPairs(known, own);
        const ExtrinsicsMinimum minimum = minimiseExtrinsics(pairs, {Vector6d::Zero()}, Clock::Kept, level.d2);
        extrinsics.body_T_sensor = minimum.correction.pose * extrinsics.body_T_sensor;
        if (boxMinus(minimum.correction.pose, Rigid::identity()).cwiseQuotient(stepOfMetres()).norm() < kSettledAtRest)
          break;
      }
    }
    return extrinsics;
  }

  RegistrationResult registered(const Extrinsics& extrinsics) const
  {
    RegistrationOptions options;
    options.d2 = options.first_d2 = kLastLevel.d2;
    NdtOptions cells;
    cells.cell_size = kLastLevel.cell_size;
    const std::vector<View> own{*viewFrom(*stations_.front().scans.front(), extrinsics, atRest(), Timestamp{})};
    return align(mapsOfReference(stations_, kLastLevel).front(), NdtMap(own, cells), Rigid::identity(), options);
  }

 private:
  std::vector<Station> stations_;
};

ExtrinsicsEstimate estimateFrom(const StaticLidar& lidar, const StaticLidar& reference, const std::vector<View>& known,
                                PoseGiven pose_given)
{
  const LidarScan scan = scanOf(lidar);
  const Instant instant(scan, known);
  const Extrinsics given{lidar.body_T_sensor, 0};
  ExtrinsicsEstimate estimate;
  estimate.extrinsics = given;
  estimate.stations = 1;
  estimate.outcome = ExtrinsicsOutcome::NothingShared;
  if (instant.cells() < kFewestCells) return estimate;
  const ExtrinsicsStart start =
      findStart(instant.stations(), pose_given == PoseGiven::No ? std::nullopt : std::optional(given), {scan},
                {scanOf(reference)}, reference.body_T_sensor, atRest(), {});
  Extrinsics extrinsics = instant.improved(start.extrinsics);
  const RegistrationResult result = instant.registered(extrinsics);
  extrinsics.body_T_sensor = result.target_T_source * extrinsics.body_T_sensor;

  const ExtrinsicsFit before = instant.fitOf(given), after = instant.fitOf(extrinsics);
  estimate.shared_before = before.shared, estimate.distance_before = before.distance;
  estimate.shared_after = after.shared, estimate.distance_after = after.distance;
  if (after.shared < kLeastSharedAtRest) return estimate;
  estimate.outcome = ExtrinsicsOutcome::Unstable;
  if (result.outcome == Outcome::IterationLimit || after.shared < before.shared - kMostShareLostAtRest) return estimate;

  const Matrix7d covariance = extrinsicsCovariance(result.covariance, result.target_T_source,
                                                   extrinsics.body_T_sensor.translation, after.distance);
  estimate = observable(std::move(estimate), extrinsics, covariance, given);
  const bool ambiguous = start.rival && fitsAsWell(instant.fitOf(*start.rival), after);
  return ambiguous ? doubted(std::move(estimate), *start.rival, given) : estimate;
}
}  // namespace

std::vector<ExtrinsicsEstimate> estimateStaticExtrinsics(const std::vector<StaticLidar>& lidars, std::size_t reference,
                                                         PoseGiven pose_given)
{
  std::vector<ExtrinsicsEstimate> estimates(lidars.size());
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < lidars.size(); ++i)
    if (i != reference) waiting.push_back(i);
  std::vector<View> known{viewOf(lidars[reference], lidars[reference].body_T_sensor)};
  Matrix7d of_known = Matrix7d::Zero();
  while (!waiting.empty())
  {
    for (const std::size_t i : waiting)
    {
      estimates[i] = estimateFrom(lidars[i], lidars[reference], known, pose_given);
      if (estimates[i].outcome == ExtrinsicsOutcome::Estimated) estimates[i].covariance += of_known;
    }
    const auto found =
        std::stable_partition(waiting.begin(), waiting.end(),
                              [&](std::size_t i) { return estimates[i].outcome != ExtrinsicsOutcome::Estimated; });
    if (found == waiting.end()) break;
    for (auto i = found; i != waiting.end(); ++i)
    {
      known.push_back(viewOf(lidars[*i], estimates[*i].extrinsics.body_T_sensor));
      if (estimates[*i].covariance.trace() > of_known.trace()) of_known = estimates[*i].covariance;
    }
    waiting.erase(found, waiting.end());
  }
  return estimates;
}

ExtrinsicsScene staticScene(const StaticLidar& reference, const StaticLidar& lidar, const Rigid& after)
{
  return {viewOf(reference, reference.body_T_sensor).points, viewOf(lidar, lidar.body_T_sensor).points,
          viewOf(lidar, after).points};
}
}  // namespace scanloom
