#include "calibration/CloudAgreement.h"

#include "estimation/ndt/Minimiser.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr std::size_t kFewestTurns = 3;  // for a deviation by leaving out one of them
constexpr double kLeastOverlap = 0.1;
constexpr double kMostLoss = 0.02;  // of near_share; a fit that loses more is wrong

/** NDT cells of each turn; those of A are registered to those of B. */
struct Turns
{
  std::vector<NdtMap> a, b;
};

enum class Which
{
  Surroundings,
  All,
};

Turns cellsOf(const std::vector<SeenByBoth>& pairs, Which which, double edge)
{
  NdtOptions options;
  options.cell_size = edge;
  const auto cells = [&](const SeenPoints& seen, Grid grid)
  { return NdtMap(viewsOf(which == Which::All ? seen.points : surroundings(seen), {}), options, grid); };
  Turns turns;
  for (const SeenByBoth& pair : pairs)
  {
    turns.a.push_back(cells(*pair.a, Grid::Turned));  // one grid for both would hold them together
    turns.b.push_back(cells(*pair.b, Grid::Straight));
  }
  return turns;
}

constexpr double kBroad = 0.2, kNarrow = 1;  // d2

constexpr std::size_t kNone = ~std::size_t{0};

/** Registers all turns at once, except the one with the index `left_out`. */
Minimum alignTurns(const Turns& turns, const Rigid& guess, double d2, std::size_t left_out = kNone)
{
  RegistrationOptions options;
  options.d2 = d2;
  std::vector<CellCorrespondences> pairs;
  for (std::size_t i = 0; i < turns.a.size(); ++i)
    if (i != left_out) pairs.emplace_back(turns.b[i], turns.a[i], options.neighbours);
  return minimise(std::move(pairs), guess, options);
}

/** How well the turns fit: the larger, the better. */
double scoreAt(const Turns& turns, const Rigid& pose)
{
  double score = 0;
  for (std::size_t i = 0; i < turns.a.size(); ++i)
  {
    CellCorrespondences pairs(turns.b[i], turns.a[i], RegistrationOptions{}.neighbours);
    score -= normalEquations(pairs, pose, kNarrow).value;
  }
  return score;
}

struct Movement
{
  Eigen::Vector3d offset, rotation;
};

Movement movementOf(const Rigid& correction, const Rigid& body_T_a)
{
  return {correction * body_T_a.translation - body_T_a.translation, logSo3(correction.rotation)};
}

/** Standard deviation, from n estimates that each lack one turn (B. Efron: The jackknife, 1982, eq. (1.5)). */
double jackknife(const std::vector<Eigen::Vector3d>& estimates)
{
  const auto n = static_cast<double>(estimates.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& estimate : estimates) mean += estimate / n;
  double squares = 0;
  for (const Eigen::Vector3d& estimate : estimates) squares += (estimate - mean).squaredNorm();
  return std::sqrt((n - 1) / n * squares);
}

std::size_t pointsOf(const std::vector<NdtMap>& maps)
{
  std::size_t points = 0;
  for (const NdtMap& map : maps) points += map.points();
  return points;
}

/** The correction of A's pose; none if too few points of A meet cells of B. */
std::optional<Rigid> alignAll(const std::vector<SeenByBoth>& pairs, const Turns& turns)
{
  Rigid pose;
  for (const double edge : {2.0, 1.0})
    pose = alignTurns(cellsOf(pairs, Which::Surroundings, edge), pose, kBroad).target_T_source;
  const Minimum minimum = alignTurns(turns, pose, kNarrow);
  if (minimum.equations.met_points < kLeastOverlap * static_cast<double>(pointsOf(turns.a))) return std::nullopt;
  return minimum.target_T_source;
}

CloudAgreement::Correction correctionOf(const Turns& turns, const Rigid& body_T_a, const Rigid& correction)
{
  const Movement movement = movementOf(correction, body_T_a);
  std::vector<Eigen::Vector3d> offsets, rotations;
  for (std::size_t i = 0; i < turns.a.size(); ++i)
  {
    const Movement without = movementOf(alignTurns(turns, correction, kNarrow, i).target_T_source, body_T_a);
    offsets.push_back(without.offset);
    rotations.push_back(without.rotation);
  }
  const double gain = scoreAt(turns, correction) / scoreAt(turns, Rigid::identity());
  return {movement.offset, movement.rotation, jackknife(offsets), jackknife(rotations), 0, gain};
}
}  // namespace

std::optional<CloudAgreement> cloudAgreement(const std::vector<SeenByBoth>& all, const Rigid& body_T_a,
                                             const Rigid& body_T_b)
{
  const std::optional<OverlapOverTurns> here = sharedView(all, Rigid::identity(), body_T_b);
  if (!here) return std::nullopt;
  CloudAgreement agreement;
  agreement.turns = here->turns.size();
  agreement.common = here->common;
  agreement.near_share = here->near_share;
  agreement.near_sigma = here->near_sigma;
  if (agreement.turns < kFewestTurns) return agreement;

  const Turns turns = cellsOf(here->turns, Which::All, 1.0);
  const std::optional<Rigid> correction = alignAll(here->turns, turns);
  if (!correction) return agreement;
  const std::optional<OverlapOverTurns> there = sharedView(here->turns, *correction, body_T_b);
  if (!there || there->near_share < here->near_share - kMostLoss) return agreement;
  agreement.correction = correctionOf(turns, body_T_a, *correction);
  agreement.correction->near_share = there->near_share;
  return agreement;
}
}  // namespace scanloom
