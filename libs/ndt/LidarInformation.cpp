#include "ndt/LidarInformation.h"

#include "ndt/KeyIndex.h"
#include "ndt/NormalEquations.h"
#include "ndt/PairEvidence.h"

#include <tbb/parallel_for.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace scanloom
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Points of one cell share beams, edges and the surface's own unevenness: past this number they teach nothing new.
constexpr double kMostIndependentPoints = 10;

// Of what no scan shows: how well range and beam angles are known on the average.
constexpr double kTranslationFloor = 0.0008;                  // m
constexpr double kRotationFloor = 0.004 * M_PI / 180 * kArm;  // m, by the arm
constexpr double kUnknownDeviation = 10;                      // m: "not measured" that still has an inverse

// Below the first share of structure the resistance against a step is that of the grid, not of the world; below the
// second it is, if a long step keeps so much of the score. Corridors keep 0.92, the densest stand 0.86 in cells of 8 m
// and 0.79 in those of 2 m.
constexpr double kBare = 0.1, kSuspicious = 0.35;
constexpr double kLongStep = 2;  // m, or a cell where that is longer
constexpr double kUnchanged = 0.9;

/** Sums over all pairs; steps in the target's frame, in m and rad, about the source's origin. */
struct Evidence
{
  Matrix6d resistance;  // sum n J' wB J, n the source cell's points
  Matrix6d structure;   // the same of thin directions only
  Matrix6d curvature;   // of the score with B held
  Matrix6d noise;       // covariance of the gradient
};

/** How the uncertain mean of a cell, and as uncertain a one of the target, shakes what it pulls at. */
Symmetric3 shaking(const Symmetric3& pull, const TurnedCell& c, std::uint32_t points)
{
  Symmetric3 shaken;
  sandwich(pull, {c.xx, c.xy, c.xz, c.yy, c.yz, c.zz}, shaken);
  return scaled(shaken, 2 / std::min<double>(points, kMostIndependentPoints));
}

/** What is known of one chunk of source cells, and the force and torque on each. */
struct ChunkEvidence
{
  PoseSum resistance, structure, curvature, noise;
  std::vector<Vector6d> forces;
};

std::vector<StructureBlock> structuresOf(const Neighbourhoods& all, const Neighbourhoods::Chunk& chunk)
{
  std::vector<StructureBlock> structures(chunk.blocks.size());
  for (std::size_t i = 0; i < chunk.cells.size(); ++i)
  {
    StructureBlock* block = structures.data() + chunk.ranges[i].first;
    std::size_t lane = 0;
    for (const std::uint32_t j : all.of(chunk.first + i))
    {
      const Matrix3d& s = all.target()[j].structure;
      block->xx[lane] = s(0, 0), block->xy[lane] = s(0, 1), block->xz[lane] = s(0, 2);
      block->yy[lane] = s(1, 1), block->yz[lane] = s(1, 2), block->zz[lane] = s(2, 2);
      if (++lane == TargetBlock::kLanes) ++block, lane = 0;
    }
  }
  return structures;
}

ChunkEvidence evidenceOf(const Neighbourhoods& all, std::size_t index, const Rigid& target_T_source, double d2)
{
  const Neighbourhoods::Chunk& chunk = all.chunk(index);
  const Matrix3d rotation = target_T_source.rotation.toRotationMatrix();
  std::array<PairEvidence, Neighbourhoods::kChunk> cells;
  ChunkEvidence evidence;
  evidence.forces.assign(chunk.cells.size(), Vector6d::Zero());
  gatherEvidence(chunk.pairs(), structuresOf(all, chunk).data(), d2, cells.data());
  for (std::size_t i = 0; i < chunk.cells.size(); ++i)
  {
    if (chunk.ranges[i].count == 0) continue;
    const GaussianCell& source = all.source()[chunk.first + i];
    const TurnedCell& c = chunk.cells[i];
    const Vector3d v = Vector3d(c.x, c.y, c.z) - target_T_source.translation;
    const Vector3d force(cells[i].fx, cells[i].fy, cells[i].fz);
    Symmetric3 structured;
    sandwich(turned(source.structure, rotation), cells[i].structured, structured);
    // By points: far cells that one row of beams crosses look thin where nothing is.
    const double points = source.points;
    evidence.resistance.add(scaled(cells[i].weight, points), v.x(), v.y(), v.z());
    evidence.structure.add(scaled(structured, points), v.x(), v.y(), v.z());
    evidence.curvature.add(cells[i].pull, v.x(), v.y(), v.z());
    evidence.noise.add(shaking(cells[i].pull, c, source.points), v.x(), v.y(), v.z());
    evidence.forces[i] << force, v.cross(force);
  }
  return evidence;
}

/**
 * What the forces differ by from place to place, where at a minimum without any error all would be zero: leaves seen
 * from another side, moved branches, ground cut by another grid. Forces within a few metres err together and count as
 * one (the cluster-robust sandwich; R. Rogers: Regression standard errors in clustered samples, Stata Technical
 * Bulletin 13, 1993).
 */
Matrix6d disagreement(const Neighbourhoods& all, const std::vector<ChunkEvidence>& chunks)
{
  constexpr double kTogether = 6;  // m
  const auto along = [](double v) { return static_cast<std::int64_t>(std::floor(v / kTogether)); };
  KeyIndex places;
  std::vector<Vector6d> sums;
  for (std::size_t c = 0; c < chunks.size(); ++c)  // in a fixed order
    for (std::size_t i = 0; i < chunks[c].forces.size(); ++i)
    {
      if (all.chunk(c).ranges[i].count == 0) continue;
      const Vector3d& mean = all.source()[all.chunk(c).first + i].mean;
      const std::uint32_t place = places.placeOf(CellKey::of(along(mean.x()), along(mean.y()), along(mean.z())));
      if (place == sums.size()) sums.push_back(Vector6d::Zero());
      sums[place] += chunks[c].forces[i];
    }
  Matrix6d squares = Matrix6d::Zero();
  for (const Vector6d& sum : sums) squares += sum * sum.transpose();
  const auto count = static_cast<double>(sums.size());
  return squares * (count / std::max(1.0, count - 6));
}

Evidence evidenceOf(const Neighbourhoods& all, const Rigid& target_T_source, double d2)
{
  std::vector<ChunkEvidence> chunks(all.chunks());
  tbb::parallel_for(std::size_t{0}, chunks.size(),
                    [&](std::size_t i) { chunks[i] = evidenceOf(all, i, target_T_source, d2); });
  Evidence evidence{Matrix6d::Zero(), Matrix6d::Zero(), Matrix6d::Zero(), disagreement(all, chunks)};
  for (const ChunkEvidence& chunk : chunks)  // in a fixed order
  {
    evidence.resistance += chunk.resistance.matrix();
    evidence.structure += chunk.structure.matrix();
    evidence.curvature += chunk.curvature.matrix();
    evidence.noise += chunk.noise.matrix();
  }
  return evidence;
}

/** Steps in the source's frame, in metres (see stepOfMetres). */
Evidence inSource(const Evidence& in_target, const Rigid& target_T_source)
{
  const Matrix3d rotation = target_T_source.rotation.toRotationMatrix();
  Matrix6d target_of_step = Matrix6d::Zero();
  target_of_step.topLeftCorner<3, 3>() = target_of_step.bottomRightCorner<3, 3>() = rotation;
  target_of_step = target_of_step * stepOfMetres().asDiagonal();
  const auto turned = [&](const Matrix6d& m) -> Matrix6d { return target_of_step.transpose() * m * target_of_step; };
  return {turned(in_target.resistance), turned(in_target.structure), turned(in_target.curvature),
          turned(in_target.noise)};
}

/** What is left of the score after a long step either way. Leaves the neighbourhoods where they were. */
double keptBy(const Vector6d& direction, Neighbourhoods& all, const Rigid& target_T_source, double d2)
{
  const Vector6d step = std::max(kLongStep, all.sourceEdge()) * stepOfMetres().cwiseProduct(direction);
  const double there = std::min(normalEquations(all, boxPlus(target_T_source, step), d2).value,
                                normalEquations(all, boxPlus(target_T_source, -step), d2).value);
  const double here = normalEquations(all, target_T_source, d2).value;
  return here < 0 ? there / here : 1;
}

/** Orthonormal. */
std::vector<Vector6d> degenerateDirections(const Evidence& evidence, Neighbourhoods& all, const Rigid& target_T_source,
                                           double d2)
{
  const Matrix6d some = 1e-9 * (1 + evidence.resistance.trace()) * Matrix6d::Identity();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6d> shares(evidence.structure, evidence.resistance + some);
  std::vector<Vector6d> directions;
  for (int i = 0; i < 6 && shares.eigenvalues()[i] < kSuspicious; ++i)
  {
    Vector6d direction = shares.eigenvectors().col(i).normalized();
    for (const Vector6d& before : directions) direction -= before.dot(direction) * before;
    direction.normalize();
    if (shares.eigenvalues()[i] < kBare || keptBy(direction, all, target_T_source, d2) > kUnchanged)
      directions.push_back(direction);
  }
  return directions;
}

/** Of the curvature, which far from a minimum need not be positive: what is not counts as little. */
Matrix6d safeInverse(const Matrix6d& symmetric)
{
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(symmetric);
  const double least = std::max(1e-12, 1e-6 * eigen.eigenvalues()[5]);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(least).cwiseInverse().asDiagonal() *
         eigen.eigenvectors().transpose();
}
}  // namespace

Vector6d stepOfMetres()
{
  Vector6d scale;
  scale << 1, 1, 1, 1 / kArm, 1 / kArm, 1 / kArm;
  return scale;
}

double largestDeviation(const Matrix6d& covariance)
{
  const Matrix6d metres =
      stepOfMetres().cwiseInverse().asDiagonal() * covariance * stepOfMetres().cwiseInverse().asDiagonal();
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Matrix6d>(metres).eigenvalues()[5]);
}

double scorePerInformation(double d2) { return d2 / kMostIndependentPoints; }

LidarInformation lidarInformation(Neighbourhoods& all, const Rigid& target_T_source, double d2)
{
  const Evidence evidence = inSource(evidenceOf(all, target_T_source, d2), target_T_source);
  const Matrix6d inverse = safeInverse(evidence.curvature);
  Matrix6d metres = inverse * evidence.noise * inverse;
  metres.diagonal().head<3>().array() += kTranslationFloor * kTranslationFloor;
  metres.diagonal().tail<3>().array() += kRotationFloor * kRotationFloor;

  LidarInformation information;
  information.degenerate = degenerateDirections(evidence, all, target_T_source, d2);
  for (const Vector6d& direction : information.degenerate)
    metres += kUnknownDeviation * kUnknownDeviation * direction * direction.transpose();
  const Matrix6d symmetric = (metres + metres.transpose()) / 2;
  information.covariance = stepOfMetres().asDiagonal() * symmetric * stepOfMetres().asDiagonal();
  return information;
}
}  // namespace scanloom
