#include "doctor/CloudAgreement.h"

#include <algorithm>
#include <cmath>

#include "core/Statistics.h"
#include "doctor/CommonView.h"
#include "ndt/Minimiser.h"

namespace scanloom
{
namespace
{
constexpr std::size_t kFewestCommon = 500;
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

Turns cellsOf(const std::vector<SnapshotPair>& pairs, Which which, double edge)
{
  NdtOptions options;
  options.cell_size = edge;
  const auto cells = [&](const Snapshot& snapshot)
  { return NdtMap(which == Which::All ? snapshot.points : surroundings(snapshot), options); };
  Turns turns;
  for (const SnapshotPair& pair : pairs)
  {
    turns.a.push_back(cells(*pair.a));
    turns.b.push_back(cells(*pair.b));
  }
  return turns;
}

constexpr std::size_t kNone = ~std::size_t{0};

/** Registers all turns at once, except the one with the index `left_out`. */
Minimum alignTurns(const Turns& turns, const Rigid& guess, double d2, std::size_t left_out = kNone)
{
  RegistrationOptions options;
  options.d2 = d2;
  std::vector<Neighbourhoods> pairs;
  for (std::size_t i = 0; i < turns.a.size(); ++i)
    if (i != left_out) pairs.emplace_back(turns.b[i], turns.a[i], options.neighbours);
  return minimise(pairs, guess, options);
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

constexpr double kBroad = 0.2, kNarrow = 1;  // d2

std::size_t pointsOf(const std::vector<NdtMap>& maps)
{
  std::size_t points = 0;
  for (const NdtMap& map : maps) points += map.points();
  return points;
}

/** The correction of A's pose; none if too few points of A meet cells of B. */
std::optional<Rigid> alignAll(const std::vector<SnapshotPair>& pairs)
{
  Rigid pose;
  for (const double edge : {2.0, 1.0})
    pose = alignTurns(cellsOf(pairs, Which::Surroundings, edge), pose, kBroad).target_T_source;
  const Turns turns = cellsOf(pairs, Which::All, 1.0);
  const Minimum minimum = alignTurns(turns, pose, kNarrow);
  if (minimum.equations.met_points < kLeastOverlap * static_cast<double>(pointsOf(turns.a))) return std::nullopt;
  return minimum.target_T_source;
}

CloudAgreement::Correction correctionOf(const std::vector<SnapshotPair>& pairs, const Rigid& body_T_a,
                                        const Rigid& correction)
{
  const Movement movement = movementOf(correction, body_T_a);
  const Turns turns = cellsOf(pairs, Which::All, 1.0);
  std::vector<Eigen::Vector3d> offsets, rotations;
  for (std::size_t i = 0; i < pairs.size() && pairs.size() > 1; ++i)
  {
    const Movement without = movementOf(alignTurns(turns, correction, kNarrow, i).target_T_source, body_T_a);
    offsets.push_back(without.offset);
    rotations.push_back(without.rotation);
  }
  return {movement.offset, movement.rotation, jackknife(offsets), jackknife(rotations), 0};
}

/** What both lidars should see. */
struct Common
{
  std::vector<SnapshotPair> pairs;  // turns with enough common points
  std::size_t points = 0;           // median over these turns, like near_share
  double near_share = 0;
};

Common commonOf(const std::vector<SnapshotPair>& all, const Rigid& body_T_b, const Rigid& correction)
{
  Common result;
  std::vector<double> points, near;
  for (const SnapshotPair& pair : all)
  {
    const CommonView view = commonView(surroundings(*pair.a), correction, pair.b->points, body_T_b);
    if (view.common < kFewestCommon) continue;
    result.pairs.push_back(pair);
    points.push_back(static_cast<double>(view.common));
    near.push_back(static_cast<double>(view.near) / points.back());
  }
  if (points.empty()) return result;
  result.points = static_cast<std::size_t>(median(points));
  result.near_share = median(near);
  return result;
}
}  // namespace

std::optional<CloudAgreement> cloudAgreement(const std::vector<SnapshotPair>& all, const Rigid& body_T_a,
                                             const Rigid& body_T_b)
{
  const Common here = commonOf(all, body_T_b, Rigid::identity());
  if (here.pairs.empty()) return std::nullopt;
  CloudAgreement agreement;
  agreement.turns = here.pairs.size();
  agreement.common = here.points;
  agreement.near_share = here.near_share;

  const std::optional<Rigid> correction = alignAll(here.pairs);
  if (!correction) return agreement;
  const Common there = commonOf(here.pairs, body_T_b, *correction);
  if (there.near_share < here.near_share - kMostLoss) return agreement;
  agreement.correction = correctionOf(here.pairs, body_T_a, *correction);
  agreement.correction->near_share = there.near_share;
  return agreement;
}
}  // namespace scanloom
