#include "lab/simulation/internal/Stand.h"

#include "lab/simulation/internal/Random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
// Assumed.
constexpr double kClusterSize = 6;     // m: distance from one dense place to the next
constexpr double kFreeLane = 2.6;      // m: within this distance of the machine's path stems are felled to stumps
constexpr double kStumpHeight = 0.25;  // m: height of stumps above the ground

constexpr double kSquareMetresPerHectare = 1e4;
constexpr double kCellSize = 2.0;  // m: at least the largest spacing, so that only neighbouring cells matter
constexpr int kCellsPerTile = 8;

/** The cells around a lane, tile by tile. */
std::vector<GridCell> cellsAround(const Lane& lane, double reach)
{
  std::vector<GridCell> cells;
  for (const GridCell& tile : lane.cellsWithin(reach, kCellsPerTile * kCellSize))
    for (int y = 0; y < kCellsPerTile; ++y)
      for (int x = 0; x < kCellsPerTile; ++x) cells.push_back({tile.x * kCellsPerTile + x, tile.y * kCellsPerTile + y});
  return cells;
}

/** Smooth noise of mean 0 in [-1, 1]: interpolated between random values at the corners of a grid of `size`. */
double smoothNoise(const Eigen::Vector2d& place, double size, std::uint64_t seed)
{
  const GridCell cell = GridCell::of(place, size);
  const auto atCorner = [&](int x, int y) {
    return Random(seed, RandomStream::Clusters, GridCell{cell.x + x, cell.y + y}.key()).uniform(-1, 1);
  };
  const auto ease = [](double u) { return u * u * (3 - 2 * u); };
  const double u = ease(place.x() / size - cell.x), v = ease(place.y() / size - cell.y);
  return (1 - v) * ((1 - u) * atCorner(0, 0) + u * atCorner(1, 0)) +
         v * ((1 - u) * atCorner(0, 1) + u * atCorner(1, 1));
}

/**
 * Random places with a smallest distance: of candidates with random places and ranks, one stays if no candidate of
 * lower rank is too near (B. Matern: Spatial Variation, 1960, type II).
 */
class Places
{
 public:
  Places(const StandOptions& options, std::uint64_t seed)
    : options_(options), seed_(seed), most_candidates_(candidatesFor(density() * (1 + options.clustering)))
  {
  }

  struct Candidate
  {
    Eigen::Vector2d place;
    double rank;
    std::uint64_t key;  // of its random numbers
  };

  /** The candidates in a cell that stay. */
  std::vector<Candidate> in(const GridCell& cell) const
  {
    if (options_.row_distance > 0) return inRows(cell);
    std::vector<Candidate> rivals;
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) addCandidates({cell.x + x, cell.y + y}, rivals);
    std::vector<Candidate> stay;
    for (const Candidate& candidate : rivals)
    {
      const auto isOusted = [&](const Candidate& rival)
      { return rival.rank < candidate.rank && (rival.place - candidate.place).norm() < options_.spacing; };
      const GridCell home = GridCell::of(candidate.place, kCellSize);
      if (home.x == cell.x && home.y == cell.y && std::none_of(rivals.begin(), rivals.end(), isOusted))
        stay.push_back(candidate);
    }
    return stay;
  }

 private:
  /** Planted every two thirds of the rows' distance, give or take some centimetres; one of twenty has died. */
  std::vector<Candidate> inRows(const GridCell& cell) const
  {
    constexpr double kPlantingError = 0.08, kDead = 0.05;  // m, 1 (assumed)
    const Eigen::Array2d step(options_.row_distance * 2 / 3, options_.row_distance);
    const Eigen::Array2d corner = kCellSize * Eigen::Array2d(cell.x, cell.y);
    const Eigen::Array2i first = (corner / step).ceil().cast<int>(),
                         end = ((corner + kCellSize) / step).ceil().cast<int>();
    std::vector<Candidate> planted;
    for (int row = first.y(); row < end.y(); ++row)
      for (int in_row = first.x(); in_row < end.x(); ++in_row)
      {
        Random random(seed_, RandomStream::Stand, GridCell{in_row, row}.key());
        const double x = random.normal(), y = random.normal();
        const bool died = random.uniform() < kDead;
        const Eigen::Vector2d place =
            (step * Eigen::Array2d(in_row, row)).matrix() + kPlantingError * Eigen::Vector2d(x, y);
        if (!died) planted.push_back({place, 0, random.bits()});
      }
    return planted;
  }

  double density() const { return options_.stems_per_hectare / kSquareMetresPerHectare; }  // 1/m2

  /** Candidates n per square metre so that `stay` of them stay: 1 - exp(-n A) = stay A, with A = pi spacing^2. */
  double candidatesFor(double stay) const
  {
    const double area = M_PI * options_.spacing * options_.spacing;
    if (stay * area > 0.95)
      throw std::invalid_argument(fmt::format(
          "[simulated_stand] spacing = {} m: at this spacing and clustering = {}, a hectare has room for {:.0f} "
          "stems, fewer than stems_per_hectare = {}; reduce the spacing",
          options_.spacing, options_.clustering, 0.95 / area / (1 + options_.clustering) * kSquareMetresPerHectare,
          options_.stems_per_hectare));
    return -std::log1p(-stay * area) / area;
  }

  void addCandidates(const GridCell& cell, std::vector<Candidate>& candidates) const
  {
    Random random(seed_, RandomStream::Stand, cell.key());
    for (int left = random.poisson(most_candidates_ * kCellSize * kCellSize); left > 0; --left)
    {
      const double x = random.uniform(), y = random.uniform();
      const Eigen::Vector2d place = kCellSize * Eigen::Vector2d(cell.x + x, cell.y + y);
      const double rank = random.uniform(), lot = random.uniform();
      const std::uint64_t key = random.bits();
      const double noise = options_.clustering > 0 ? smoothNoise(place, kClusterSize, seed_) : 0;
      if (lot * most_candidates_ < candidatesFor(density() * (1 + options_.clustering * noise)))
        candidates.push_back({place, rank, key});
    }
  }

  StandOptions options_;
  std::uint64_t seed_;
  double most_candidates_;  // 1/m2
};

Cone stumpOf(const Stem& stem, double height)
{
  const Cone wood = stem.wood();
  const double length = (stem.foot - wood.base).norm() + height;
  const double tip = wood.base_radius + (wood.tip_radius - wood.base_radius) * length / wood.length;
  return {wood.base, wood.axis, length, wood.base_radius, tip};
}
}  // namespace

Stand growStand(const StandOptions& options, const TreeOptions& trees, const Ground& ground, const Lane& lane,
                std::uint64_t seed)
{
  const Places places(options, seed);
  StandOptions of_old_stems = options;
  of_old_stems.stems_per_hectare = options.stumps_per_hectare;
  of_old_stems.clustering = of_old_stems.row_distance = 0;
  const Places old_places(of_old_stems, seed ^ 0x01d);  // other random numbers than the living stems

  const auto grow = [&](const Places::Candidate& candidate)
  {
    Random random(seed, RandomStream::Trees, candidate.key);
    const Eigen::Vector2d& p = candidate.place;
    return growTree(trees, {p.x(), p.y(), ground.height(p.x(), p.y())}, random);
  };
  const auto isFelled = [&](const Places::Candidate& candidate)
  {
    return lane.passes(candidate.place, kFreeLane) ||
           Random(seed, RandomStream::FelledTrees, candidate.key).uniform() < options.felled;
  };
  Stand stand;
  for (const GridCell& cell : cellsAround(lane, options.reach))
  {
    for (const Places::Candidate& candidate : places.in(cell))
    {
      const Stem stem = grow(candidate);
      if (isFelled(candidate))
        stand.stumps.push_back(stumpOf(stem, kStumpHeight));
      else
        stand.stems.push_back(stem);
    }
    for (const Places::Candidate& candidate : old_places.in(cell))
      stand.stumps.push_back(stumpOf(grow(candidate), kStumpHeight));
  }
  return stand;
}
}  // namespace scanloom
