#include "estimation/slam/PlaceSearch.h"

#include "base/core/Angle.h"
#include "estimation/graph/PosePriorFactor.h"
#include "estimation/ndt/FittedConstants.h"
#include "estimation/ndt/ForestCorrections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace scanloom
{
namespace
{
constexpr int kHeadings = 24;      // all around
constexpr int kHeadingsAside = 2;  // to each side of a known one, as far apart

/** Starts on a grid, compared in the cells of one level. */
struct Screening
{
  double grid;        // m
  std::size_t level;  // of MapLevels
};

/** Cells of 4 m find most places in a fifth of the time; rows of stems alike take cells of 2 m. */
constexpr std::array kScreenings{Screening{3, 1}, Screening{2, 2}};

Rigid turned(const Eigen::Vector3d& at, double heading)
{
  return Rigid::fromXyzYawPitchRoll(at.x(), at.y(), at.z(), heading, 0, 0);
}

Rigid levelled(const Rigid& pose) { return turned(pose.translation, pose.yawPitchRoll().x()); }

/** Places on a grid around the map's keyframes, each at the height of the nearest of them. */
std::vector<Eigen::Vector3d> placesIn(const PriorMap& map, double grid)
{
  std::map<std::pair<long, long>, std::pair<double, double>> nearest;  // of a place: distance and height
  const long reach = std::lround(fitted::kReachOfMap / grid);
  for (const PriorMap::Keyframe& keyframe : map.keyframes())
  {
    const Eigen::Vector3d& at = keyframe.map_T_body.translation;
    const long i = std::lround(at.x() / grid), j = std::lround(at.y() / grid);
    for (long x = i - reach; x <= i + reach; ++x)
      for (long y = j - reach; y <= j + reach; ++y)
      {
        const double distance = std::hypot(at.x() - grid * double(x), at.y() - grid * double(y));
        if (distance > fitted::kReachOfMap) continue;
        const auto [place, is_new] = nearest.try_emplace({x, y}, distance, at.z());
        if (!is_new && distance < place->second.first) place->second = {distance, at.z()};
      }
  }
  std::vector<Eigen::Vector3d> places;
  for (const auto& [place, value] : nearest)
    places.emplace_back(grid * double(place.first), grid * double(place.second), value.second);
  return places;
}

std::vector<Rigid> startsIn(const PriorMap& map, double grid)
{
  std::vector<Rigid> starts;
  for (const Eigen::Vector3d& place : placesIn(map, grid))
    for (int i = 0; i < kHeadings; ++i) starts.push_back(turned(place, 2 * M_PI * i / kHeadings));
  return starts;
}

std::vector<Rigid> startsAbout(const Rigid& map_T_level, double reach_of_guess, double grid)
{
  if (reach_of_guess < grid / 2) return {map_T_level};
  const double heading = map_T_level.yawPitchRoll().x();
  const int reach = static_cast<int>(std::ceil(reach_of_guess / grid));
  std::vector<Rigid> starts;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int i = -kHeadingsAside; i <= kHeadingsAside; ++i)
        starts.push_back(turned(map_T_level.translation + Eigen::Vector3d(grid * x, grid * y, 0),
                                heading + 2 * M_PI * i / kHeadings));
  return starts;
}

double leanOf(const Rigid& pose) { return std::acos(std::min(1.0, (pose.rotation * Eigen::Vector3d::UnitZ()).z())); }

/** Whether the body is where the place of the keyframe before says that it is by now. */
bool areSame(const Rigid& by_keyframe_before, const Rigid& map_T_body)
{
  const Vector6d apart = boxMinus(by_keyframe_before, map_T_body);
  return apart.head<3>().norm() < fitted::kSamePlace && apart.tail<3>().norm() < fitted::kSamePlaceDeg * kDegree;
}

/** Keyframes of one drive, and places in the map beside each other, err alike: a registration of all of them states too
 * little. Places that may differ by so much are known to a third of it. */
Matrix6d withSharedErrors(Matrix6d covariance)
{
  covariance.diagonal().head<3>().array() += std::pow(fitted::kSamePlace / 3, 2);
  covariance.diagonal().tail<3>().array() += std::pow(fitted::kSamePlaceDeg * kDegree / 3, 2);
  return covariance;
}

/** Nothing, one place, or places that look alike. Candidates come best first. */
struct Judged
{
  PlaceOutcome outcome = PlaceOutcome::NotInMap;
  std::optional<RegistrationResult> place;
  double best_score = 0;  // negative, as all are
};

/** A drive's frame that leans in the map by more than `lean` is a wrong place: gravity has levelled both. */
Judged judged(const std::vector<RegistrationResult>& candidates, const Rigid& drive_T_level, double own_score,
              double lean)
{
  const auto isRight = [&](const RegistrationResult& found)
  {
    return isPlace(found) && found.score < fitted::kAgreementOfPlace * own_score &&  // scores are negative
           leanOf(found.target_T_source * drive_T_level.inverse()) < lean;
  };
  const auto best = std::find_if(candidates.begin(), candidates.end(), isRight);
  const double score = candidates.empty() ? 0 : candidates.front().score;
  if (best == candidates.end()) return {PlaceOutcome::NotInMap, std::nullopt, score};
  const auto isRival = [&](const RegistrationResult& other)
  {
    return other.score < fitted::kScoreOfRival * best->score && isFarFrom(other.target_T_source, best->target_T_source);
  };
  if (std::any_of(candidates.begin(), candidates.end(), isRival)) return {PlaceOutcome::LookAlike, std::nullopt, score};
  return {PlaceOutcome::Unconfirmed, *best, best->score};
}
}  // namespace

std::string toString(PlaceOutcome outcome)
{
  switch (outcome)
  {
    case PlaceOutcome::Found:
      return "found";
    case PlaceOutcome::Unconfirmed:
      return "unconfirmed";
    case PlaceOutcome::LookAlike:
      return "look alike";
    case PlaceOutcome::NotInMap:
      break;
  }
  return "not in map";
}

PlaceSearch::PlaceSearch(std::shared_ptr<const PriorMap> map, const SlamSettings& settings,
                         const std::vector<MountedLidar>& lidars, const std::optional<PlaceGuess>& about, LevelBy level)
  : map_(std::move(map)),
    map_cells_(settings.map_cells),
    cells_(settings.registration.fine_cells),
    alignment_(settings.registration.fine),
    levels_(map_->whole()),
    body_T_lidar_(posesOf(lidars)),
    corrections_(cellCorrections(settings.slam.forest)),
    lean_((level == LevelBy::Imu ? fitted::kWorkingImuDeg : fitted::kLeanOfStartDeg) * kDegree),
    about_(about)
{
}

void PlaceSearch::see(const Keyframe& keyframe)
{
  seen_.push_back({keyframe.map_T_body, viewsOf(keyframe.points, body_T_lidar_, corrections_)});
  if (seen_.size() > fitted::kKeyframesTogether) seen_.pop_front();
  if (about_ && !map_T_drive_about_)
    map_T_drive_about_ = levelled(about_->map_T_body) * levelled(keyframe.map_T_body).inverse();
}

SearchedPlace PlaceSearch::add(const Keyframe& keyframe)
{
  see(keyframe);
  const Rigid& drive_T_body = keyframe.map_T_body;
  const Rigid drive_T_level = levelled(drive_T_body);

  const std::vector<View> together = seenFrom(drive_T_level);
  const double own_score = scoreWithItself(together, map_cells_, cells_, alignment_);
  Judged found;
  for (const Screening& screening : kScreenings)
  {
    if (found.outcome != PlaceOutcome::NotInMap) break;
    const auto candidates = placesFrom(levels_, screening.level, together, starts(screening.grid, drive_T_level),
                                       fitted::kPlacesAligned, cells_, alignment_);
    found = judged(candidates, drive_T_level, own_score, lean_);
  }
  const double agreement = found.best_score / own_score;
  if (!found.place) return {found.outcome, std::nullopt, agreement};
  const Rigid map_T_drive = found.place->target_T_source * drive_T_level.inverse();
  const Matrix6d covariance = movedTo(drive_T_level.inverse() * drive_T_body, found.place->covariance);
  const FoundPlace place{map_T_drive, map_T_drive * drive_T_body, withSharedErrors(covariance), covariance};
  return {confirmed(place, drive_T_body), place, agreement};
}

std::vector<View> PlaceSearch::seenFrom(const Rigid& drive_T_level) const
{
  std::vector<View> together;
  for (const Seen& seen : seen_)
    for (View& view : movedBy(drive_T_level.inverse() * seen.drive_T_body, seen.views))
      together.push_back(std::move(view));
  return together;
}

std::vector<Rigid> PlaceSearch::starts(double grid, const Rigid& drive_T_level) const
{
  return map_T_drive_about_ ? startsAbout(*map_T_drive_about_ * drive_T_level, about_->reach, grid)
                            : startsIn(*map_, grid);
}

PlaceOutcome PlaceSearch::confirmed(const FoundPlace& place, const Rigid& drive_T_body)
{
  const std::optional<Rigid> before = std::exchange(map_T_drive_, place.map_T_drive);
  const bool is_confirmed = about_ || (before && areSame(*before * drive_T_body, place.map_T_body));
  return is_confirmed ? PlaceOutcome::Found : PlaceOutcome::Unconfirmed;
}
}  // namespace scanloom
