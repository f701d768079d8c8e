#include "calibration/ExtrinsicsSearch.h"

#include "base/core/Angle.h"
#include "base/core/So3.h"
#include "calibration/ScansOfDrive.h"
#include "calibration/internal/ExtrinsicsCovariance.h"
#include "calibration/internal/ExtrinsicsEquations.h"
#include "calibration/internal/StationMaps.h"
#include "calibration/internal/someOf.h"

#include <algorithm>
#include <functional>

namespace scanloom
{
namespace
{
constexpr std::size_t kCompared = 8;      // stations
constexpr std::size_t kScansAtStart = 4;  // of a station
constexpr ExtrinsicsLevel kWideLevel{4.0, 0.05, kScansAtStart}, kNarrowLevel{2.0, 0.5, kScansAtStart},
    kFineLevel{1.0, 0.4, kScansAtStart};

/** Without ground and crowns in thick cells, which fit nearly as well the wrong way round. */
constexpr ExtrinsicsLevel scoredLevel()
{
  ExtrinsicsLevel level = kFinestLevel;
  level.scans = kScansAtStart;
  return level;
}

/** At some stations. */
class LevelOfSearch
{
 public:
  LevelOfSearch(const ExtrinsicsLevel& level, const std::vector<Station>& stations, const Trajectory& trajectory)
    : level_(level), stations_(stations), trajectory_(trajectory), reference_(mapsOfReference(stations, level))
  {
  }

  Extrinsics refined(Extrinsics extrinsics) const
  {
    const StationCells lidar = cellsOfLidar(stations_, extrinsics, trajectory_, level_);
    std::vector<CellCorrespondences> pairs = stationPairs(reference_, lidar);
    extrinsics.body_T_sensor =
        minimiseExtrinsics(pairs, at_rest_, Clock::Kept, level_.d2).correction.pose * extrinsics.body_T_sensor;
    return extrinsics;
  }

  /** Points that are where the reference saw something. */
  double scoreOf(const Extrinsics& extrinsics) const
  {
    const StationCells lidar = cellsOfLidar(stations_, extrinsics, trajectory_, level_);
    std::vector<CellCorrespondences> pairs = stationPairs(reference_, lidar);
    return extrinsicsEquations(pairs, at_rest_, {}, level_.d2).met_points;
  }

 private:
  ExtrinsicsLevel level_;
  const std::vector<Station>& stations_;
  const Trajectory& trajectory_;
  std::vector<NdtMap> reference_;
  std::vector<Vector6d> at_rest_ = std::vector<Vector6d>(stations_.size(), Vector6d::Zero());
};

struct Candidate
{
  Extrinsics extrinsics;
  double score;  // points that are where the reference saw something
};

/**
 * From each start as it is and refined, most points first. Lidars that look apart have the more in common the farther
 * one is moved along the drive: what cannot be is left out.
 */
std::vector<Candidate> candidatesFrom(const std::vector<Extrinsics>& starts, const std::vector<Station>& all,
                                      const Trajectory& trajectory,
                                      const std::function<bool(const Extrinsics&)>& isImpossible)
{
  const std::vector<Station> stations = someOf(all, kCompared);
  const LevelOfSearch wide(kWideLevel, stations, trajectory), narrow(kNarrowLevel, stations, trajectory),
      fine(kFineLevel, stations, trajectory), scored(scoredLevel(), stations, trajectory);
  std::vector<Candidate> candidates;
  for (const Extrinsics& start : starts)
    for (const Extrinsics& near : {start, narrow.refined(start), narrow.refined(wide.refined(start))})
    {
      const Extrinsics extrinsics = fine.refined(fine.refined(near));
      if (!isImpossible(extrinsics)) candidates.push_back({extrinsics, scored.scoreOf(extrinsics)});
    }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  return candidates;
}

/** The best, and the next best elsewhere if it is nearly as good; the guess if there is none. */
ExtrinsicsStart chosenFrom(const std::vector<Candidate>& best_first, const Extrinsics& guess)
{
  constexpr double kElsewhere = 0.3;  // m (changeInMetres): farther than refinement leaves starts of one place apart
  constexpr double kNearlyAsGood = 0.8;
  if (best_first.empty()) return {guess, std::nullopt};
  ExtrinsicsStart start{best_first.front().extrinsics, std::nullopt};
  for (const Candidate& other : best_first)
    if (!start.rival && other.score > kNearlyAsGood * best_first.front().score &&
        changeInMetres(start.extrinsics, other.extrinsics).norm() > kElsewhere)
      start.rival = other.extrinsics;
  return start;
}

/** Turned so that the lidar sees the ground in the plane in which the reference sees it. */
Extrinsics levelled(Extrinsics extrinsics, const std::optional<GroundPlane>& ground, const GroundPlane& of_reference)
{
  if (!ground) return extrinsics;
  Rigid& pose = extrinsics.body_T_sensor;
  pose.rotation = (rotationBetween(ground->up, of_reference.up) * pose.rotation).normalized();
  pose.translation += (ground->sensor_height - of_reference.heightOf(pose.translation)) * of_reference.up;
  return extrinsics;
}

/** The extrinsics turned about `up` by `count` multiples of `step`, the same to both sides. */
std::vector<Extrinsics> headingsAround(const Extrinsics& extrinsics, const Eigen::Vector3d& up, int count, double step)
{
  const int middle = count / 2;
  std::vector<Extrinsics> headings(static_cast<std::size_t>(count), extrinsics);
  for (int i = 0; i < count; ++i)
    headings[i].body_T_sensor.rotation = Eigen::AngleAxisd((i - middle) * step, up) * extrinsics.body_T_sensor.rotation;
  return headings;
}

/** The extrinsics, and the same 1.5 m away across `up` on four sides. */
std::vector<Extrinsics> placesAround(const Extrinsics& extrinsics, const Eigen::Vector3d& up)
{
  const Eigen::Vector3d x = 1.5 * up.unitOrthogonal(), y = up.cross(x);
  std::vector<Extrinsics> places(5, extrinsics);
  places[1].body_T_sensor.translation += x;
  places[2].body_T_sensor.translation -= x;
  places[3].body_T_sensor.translation += y;
  places[4].body_T_sensor.translation -= y;
  return places;
}

/** At the reference's place, as the IMUs tell its rotation, or upright by them. */
Extrinsics guessWithoutPose(const Rigid& body_T_reference, const RotationByImus& imus)
{
  Extrinsics guess{{Eigen::Quaterniond::Identity(), body_T_reference.translation}, 0};
  if (imus.turns)
    guess.body_T_sensor.rotation = imus.turns->body_R_lidar;
  else if (imus.gravity)
    guess.body_T_sensor.rotation = rotationBetween(imus.gravity->up_in_lidar, imus.gravity->up_in_body);
  return guess;
}

std::vector<Extrinsics> startsAround(const Extrinsics& guess, const Eigen::Vector3d& up, bool is_given,
                                     const RotationByImus& imus)
{
  if (is_given) return headingsAround(guess, up, 5, 10 * kDegree);
  return imus.turns ? placesAround(guess, up) : headingsAround(guess, up, 12, 30 * kDegree);
}
}  // namespace

ExtrinsicsStart findStart(const std::vector<Station>& stations, const std::optional<Extrinsics>& given,
                          const std::vector<LidarScan>& of_lidar, const std::vector<LidarScan>& of_reference,
                          const Rigid& body_T_reference, const Trajectory& trajectory, const RotationByImus& imus)
{
  const Extrinsics guess = given ? *given : guessWithoutPose(body_T_reference, imus);
  const Eigen::Vector3d up = !given && imus.gravity ? imus.gravity->up_in_body : Eigen::Vector3d::UnitZ();
  const std::optional<GroundPlane> ground = groundOf(of_reference, body_T_reference, up);
  const Extrinsics level = ground ? levelled(guess, groundOf(of_lidar, guess.body_T_sensor, up), *ground) : guess;
  std::vector<Extrinsics> starts = startsAround(level, ground ? ground->up : up, given.has_value(), imus);
  starts.push_back(guess);

  const double farthest = given ? 0.7 : 5;  // m
  const auto isImpossible = [&](const Extrinsics& extrinsics)
  {
    const Eigen::Vector3d moved = extrinsics.body_T_sensor.translation - guess.body_T_sensor.translation;
    return moved.norm() > farthest || contradicts(imus, extrinsics.body_T_sensor.rotation);
  };
  return chosenFrom(candidatesFrom(starts, stations, trajectory, isImpossible), guess);
}
}  // namespace scanloom
