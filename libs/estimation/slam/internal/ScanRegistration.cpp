#include "estimation/slam/internal/ScanRegistration.h"

#include "base/core/Angle.h"
#include "base/core/Decompositions.h"
#include "estimation/ndt/FittedConstants.h"
#include "estimation/ndt/LidarInformation.h"
#include "estimation/ndt/Minimiser.h"
#include "estimation/ndt/NormalEquations.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace scanloom
{
namespace
{
constexpr std::array kFactors{8, 4, 2, 1};  // cell sizes of the levels over that of the map, coarse first

struct Scored
{
  Rigid pose;
  double value = 0;
};

bool hasBetterScore(const Scored& a, const Scored& b) { return a.value < b.value; }  // scores are negative

std::vector<Rigid> posesOf(const std::vector<Scored>& scored)
{
  std::vector<Rigid> poses;
  for (const Scored& s : scored) poses.push_back(s.pose);
  return poses;
}

constexpr std::size_t kAllCells = std::numeric_limits<std::size_t>::max();

/** `most` of the cells, or all; their order is that of places. */
std::vector<GaussianCell> evenly(const std::vector<GaussianCell>& cells, std::size_t most)
{
  if (cells.size() <= most) return cells;
  std::vector<GaussianCell> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(cells[i * cells.size() / most]);
  return some;
}

/** Far off, cells of fewer points mislead. */
NdtOptions withFullCells(NdtOptions cells)
{
  cells.min_points = std::max(cells.min_points, GaussianCell::kMinPointsForCovariance);
  return cells;
}

/** Map and scan in cells of several sizes, made once for searches from many places. */
class Pyramid
{
 public:
  /** `broad`: the level whose cells are large enough for poses between the starts. */
  Pyramid(const MapLevels& map, const std::vector<View>& views, const NdtOptions& cells, std::size_t broad = 1)
    : targets_(map.levels), broad_(broad)
  {
    std::vector<double> sizes;
    for (const NdtMap& level : targets_) sizes.push_back(level.options().cell_size);
    sources_ = ndtLevels(views, sizes, withFullCells(cells), Grid::Turned);
  }

  RegistrationResult align(const PoseGuess& guess, const RegistrationOptions& options) const
  {
    return alignCoarseToFine(pairLevels(targets_, sources_), guess, options);
  }

  /**
   * The `count` starts with the best scores, best first, by `most` of the scan's cells, evenly among all. Cells are
   * large enough for poses between the starts.
   */
  std::vector<Scored> best(const std::vector<Rigid>& starts, std::size_t count, std::size_t most) const
  {
    const std::vector<GaussianCell> cells = evenly(sources_[broad_].cells(), most);
    std::vector<Scored> scores(starts.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, starts.size(), 16),
                      [&](const tbb::blocked_range<std::size_t>& range)
                      {
                        CellCorrespondences correspondences(targets_[broad_], cells,
                                                            sources_[broad_].options().cell_size, 7);
                        for (std::size_t i = range.begin(); i < range.end(); ++i)
                          scores[i] = {starts[i], normalEquations(correspondences, starts[i], fitted::kBroadD2).value};
                      });
    std::stable_sort(scores.begin(), scores.end(), hasBetterScore);
    scores.resize(std::min(count, scores.size()));
    return scores;
  }

  /**
   * The `count` starts with the best scores, each moved a few steps towards the minimum; the one with the best score
   * there comes first. Scores of the starts themselves prefer the middle of the map, where most cells meet. Cells are
   * large enough for poses between the starts.
   */
  std::vector<Rigid> mostPromising(const std::vector<Rigid>& starts, std::size_t count) const
  {
    RegistrationOptions few;
    few.d2 = few.first_d2 = fitted::kBroadD2;
    few.max_iterations = 5;
    few.neighbours = 7;
    CellCorrespondences correspondences(targets_[broad_], sources_[broad_], few.neighbours);
    std::vector<Scored> moved = best(starts, count, kAllCells);
    for (Scored& s : moved)
    {
      const Minimum near = minimise(correspondences, s.pose, {}, few, {});
      s = {near.target_T_source, near.equations.value};
    }
    std::stable_sort(moved.begin(), moved.end(), hasBetterScore);
    return posesOf(moved);
  }

 private:
  const std::vector<NdtMap>& targets_;
  std::size_t broad_;
  std::vector<NdtMap> sources_;
};

bool agrees(const RegistrationResult& result, const PoseGuess& guess)
{
  return result.trustworthy() && mahalanobisOf(result, guess) < fitted::kUsualDistance;
}

bool fitsAsWell(const RegistrationResult& result, double score)
{
  return result.score < fitted::kScoreOfAgreement * score;  // scores are negative
}

}  // namespace

MapLevels::MapLevels(const NdtMap& map)
{
  for (const int factor : kFactors) levels.push_back(map.coarser(factor));
}

ScanRegistrationOptions withLimitedEffort(ScanRegistrationOptions options)
{
  options.fine.max_iterations = std::min(options.fine.max_iterations, 15);
  return options;
}

bool isWithinReach(const PoseGuess& guess, const NdtOptions& cells)
{
  return guess.covariance && 3 * largestDeviation(*guess.covariance) <= fitted::kReachOfCells * cells.cell_size;
}

Timed<RegistrationResult> registerRoughly(const NdtMap& map, const std::vector<View>& views, const PoseGuess& guess,
                                          const ScanRegistrationOptions& options)
{
  StageRuns times;
  if (guess.covariance && !isWithinReach(guess, options.scan_cells))
  {
    const auto throughPyramid = [&]
    {
      const MapLevels levels(map);
      return Pyramid(levels, views, options.fine_cells).align(guess, options.rough);
    };
    return {times.measure("rough_alignment", throughPyramid), times};
  }
  const NdtMap scan = times.measure("scan_ndt", [&] { return NdtMap(views, options.scan_cells, Grid::Turned); });
  const auto fromGuess = [&] { return align(map, scan, guess.target_T_source, options.rough); };
  return {times.measure("rough_alignment", fromGuess), times};
}

Timed<RegistrationResult> registerFinely(const NdtMap& map, const std::vector<View>& views, const Rigid& start,
                                         const ScanRegistrationOptions& options)
{
  StageRuns times;
  const NdtMap scan = times.measure("scan_ndt", [&] { return NdtMap(views, options.fine_cells, Grid::Turned); });
  return {times.measure("fine_alignment", [&] { return align(map, scan, start, options.fine); }), times};
}

Timed<RegistrationResult> registerTwice(const NdtMap& map, const std::vector<View>& views, const PoseGuess& guess,
                                        std::optional<double> usual_score, const ScanRegistrationOptions& options)
{
  StageRuns times;
  const NdtMap scan = times.measure("scan_ndt", [&] { return NdtMap(views, options.fine_cells, Grid::Turned); });
  const auto fineFrom = [&](const Rigid& start)
  { return times.measure("fine_alignment", [&] { return align(map, scan, start, options.fine); }); };
  std::optional<RegistrationResult> near;
  if (usual_score && isWithinReach(guess, options.fine_cells))
  {
    near = fineFrom(guess.target_T_source);
    if (agrees(*near, guess) && fitsAsWell(*near, *usual_score)) return {*near, times};
  }
  const auto [rough, rough_times] = registerRoughly(map, views, guess, options);
  times = times + rough_times;
  if (!rough.trustworthy())
  {
    if (!near) near = fineFrom(guess.target_T_source);
    return {*near, times};
  }
  const RegistrationResult far = fineFrom(rough.target_T_source);
  if (agrees(far, guess)) return {far, times};
  if (!near) near = fineFrom(guess.target_T_source);
  return {agrees(*near, guess) && fitsAsWell(*near, far.score) ? *near : far, times};
}

double mahalanobisOf(const RegistrationResult& registration, const PoseGuess& predicted)
{
  const Vector6d apart = boxMinus(registration.target_T_source, predicted.target_T_source);
  const std::optional<Vector6d> weighed = solvePositive(*predicted.covariance + registration.covariance, apart);
  return weighed ? std::sqrt(apart.dot(*weighed)) : std::numeric_limits<double>::infinity();
}

Matrix6d covarianceWithin(const SearchArea& area, const RegistrationResult& found)
{
  const double tilt = 15 * kDegree, turn = area.headings > 1 ? M_PI : 25 * kDegree;
  Vector6d most;
  most << Eigen::Vector3d::Constant(area.radius + fitted::kStartsApart), tilt, tilt, turn;
  const Matrix6d expected = most.cwiseAbs2().cwiseInverse().asDiagonal();
  return inverseOfPositive(found.information + expected);
}

std::vector<Rigid> startsWithin(const SearchArea& area)
{
  const int reach = static_cast<int>(std::ceil(area.radius / fitted::kStartsApart));
  std::vector<Rigid> starts;
  for (int heading = 0; heading < area.headings; ++heading)
    for (int x = -reach; x <= reach; ++x)
      for (int y = -reach; y <= reach; ++y)
        starts.push_back(area.map_T_body * Rigid::fromXyzYawPitchRoll(x * fitted::kStartsApart,
                                                                      y * fitted::kStartsApart, 0,
                                                                      2 * M_PI * heading / area.headings, 0, 0));
  return starts;
}

bool isFarFrom(const Rigid& pose, const Rigid& other)
{
  const Vector6d apart = boxMinus(pose, other);
  return apart.head<3>().norm() > 1 || apart.tail<3>().norm() > 0.1;
}

bool isPlace(const RegistrationResult& result)
{
  return result.outcome == Outcome::Converged && result.overlap >= fitted::kOverlapOfPlace &&
         result.covariance.topLeftCorner<3, 3>().trace() < fitted::kDeviationOfPlace * fitted::kDeviationOfPlace;
}

double scoreWithItself(const std::vector<View>& views, const NdtOptions& map_cells, const NdtOptions& cells,
                       const RegistrationOptions& options)
{
  return align(NdtMap(views, map_cells), NdtMap(views, withFullCells(cells), Grid::Turned), Rigid::identity(), options)
      .score;
}

std::vector<RegistrationResult> placesFrom(const MapLevels& map, std::size_t level, const std::vector<View>& views,
                                           const std::vector<Rigid>& starts, std::size_t count, const NdtOptions& cells,
                                           const RegistrationOptions& options)
{
  const Pyramid pyramid(map, views, cells, level);
  std::vector<Rigid> apart;
  const std::vector<Rigid> likely = posesOf(pyramid.best(starts, 100 * count, fitted::kCellsToScreen));
  for (const Rigid& start : pyramid.mostPromising(likely, 10 * count))
  {
    const auto isNear = [&](const Rigid& other) { return !isFarFrom(start, other); };
    if (apart.size() < count && std::none_of(apart.begin(), apart.end(), isNear)) apart.push_back(start);
  }
  std::vector<RegistrationResult> found;
  for (const Rigid& start : apart) found.push_back(pyramid.align(start, options));
  std::stable_sort(found.begin(), found.end(), [](auto& a, auto& b) { return a.score < b.score; });
  return found;
}

std::optional<RegistrationResult> relocalise(const NdtMap& map, const std::vector<View>& views,
                                             const std::vector<Rigid>& starts,
                                             const std::function<bool(const Rigid& map_T_body)>& isPossible,
                                             const NdtOptions& cells, const RegistrationOptions& options)
{
  const std::size_t others = 2;  // are tried only where the first is a place
  const MapLevels levels(map);
  const Pyramid pyramid(levels, views, cells);
  std::vector<RegistrationResult> found;
  for (const Rigid& start : pyramid.mostPromising(starts, 1 + others))
  {
    RegistrationResult result = pyramid.align(start, options);
    if (isPlace(result) && isPossible(result.target_T_source)) found.push_back(std::move(result));
    if (found.empty()) return std::nullopt;
  }
  if (found.empty()) return std::nullopt;
  const auto best = std::min_element(found.begin(), found.end(), [](auto& a, auto& b) { return a.score < b.score; });
  const auto isRival = [&](const RegistrationResult& other)
  {
    return other.score < fitted::kScoreOfRival * best->score && isFarFrom(other.target_T_source, best->target_T_source);
  };
  if (std::any_of(found.begin(), found.end(), isRival)) return std::nullopt;
  return *best;
}
}  // namespace scanloom
