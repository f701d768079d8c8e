#include "estimation/ndt/LidarInformation.h"

#include "base/core/Decompositions.h"
#include "base/core/forAll.h"
#include "estimation/ndt/FittedConstants.h"
#include "estimation/ndt/NormalEquations.h"
#include "estimation/ndt/internal/KeyIndex.h"
#include "estimation/ndt/internal/PairInformation.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace scanloom
{
namespace
{
constexpr double kOpen = 10;  // m: the deviation along what is not measured

using Eigen::Matrix3d;
using Eigen::Vector3d;

/** Sums over all pairs, for steps in the target's frame, in m and rad, about the source's origin. */
struct Evidence
{
  std::vector<PairInformation> cells;        // one per source cell
  Matrix6d resistance = Matrix6d::Zero();    // sum n J' wB J, n the source cell's points
  Matrix6d structure = Matrix6d::Zero();     // the same, thin directions only
  Matrix6d gauss_newton = Matrix6d::Zero();  // sum J' wB J, never indefinite
  Matrix6d unsure_means = Matrix6d::Zero();  // covariance of the gradient due to the noise of the cells' means
};

/** Covariance of a cell's force due to the noise of its mean and, taken as equal, of the target's. */
Symmetric3 forceNoise(const Symmetric3& pull, const TurnedCell& c, std::uint32_t points)
{
  const Symmetric3 noise = sandwich(pull, {c.xx, c.xy, c.xz, c.yy, c.yz, c.zz});
  // Points of one cell share beams, edges and the roughness of the surface: more of them add no information.
  return scaled(noise, 2 / std::min<double>(points, fitted::kIndependentPoints));
}

/** From the source's origin to the cell, along the target's axes. */
Vector3d armOf(const TurnedCell& c, const Rigid& target_T_source)
{
  return Vector3d(c.x, c.y, c.z) - target_T_source.translation;
}

struct InformationSums
{
  PoseSum resistance, structure, gauss_newton, unsure_means;
};

std::vector<SymmetricBlock> structuresOf(const CellCorrespondences& all, const CellCorrespondences::Chunk& chunk)
{
  std::vector<SymmetricBlock> structures(chunk.blocks.size());
  for (std::size_t i = 0; i < chunk.cells.size(); ++i)
  {
    SymmetricBlock* block = structures.data() + chunk.ranges[i].first;
    std::size_t lane = 0;
    for (const std::uint32_t j : all.of(chunk.first + i))
    {
      block->set(lane, all.target()[j].structure);
      if (++lane == TargetBlock::kLanes) ++block, lane = 0;
    }
  }
  return structures;
}

/** Fills `cells`, the chunk's part of Evidence::cells. */
InformationSums gather(const CellCorrespondences& all, std::size_t index, const Rigid& target_T_source, double d2,
                       PairInformation* cells)
{
  const CellCorrespondences::Chunk& chunk = all.chunk(index);
  const Matrix3d rotation = target_T_source.rotation.toRotationMatrix();
  gatherPairs(chunk.pairs(), structuresOf(all, chunk).data(), d2, cells);
  InformationSums sums;
  for (std::size_t i = 0; i < chunk.cells.size(); ++i)
  {
    if (chunk.ranges[i].count == 0) continue;
    const GaussianCell& source = all.source()[chunk.first + i];
    const TurnedCell& c = chunk.cells[i];
    const Vector3d v = armOf(c, target_T_source);
    const Symmetric3 structured = sandwich(turned(source.structure, rotation), cells[i].structured);
    // Weighted by points, because far cells that one row of beams crosses look thin in directions without structure.
    const double points = source.points;
    sums.resistance.add(scaled(cells[i].weight, points), v.x(), v.y(), v.z());
    sums.structure.add(scaled(structured, points), v.x(), v.y(), v.z());
    sums.gauss_newton.add(cells[i].weight, v.x(), v.y(), v.z());
    sums.unsure_means.add(forceNoise(cells[i].pull, c, source.points), v.x(), v.y(), v.z());
  }
  return sums;
}

Evidence evidenceOf(const CellCorrespondences& all, const Rigid& target_T_source, double d2)
{
  Evidence evidence;
  evidence.cells.resize(all.source().size());
  std::vector<InformationSums> chunks(all.chunks());
  tbb::parallel_for(std::size_t{0}, chunks.size(),
                    [&](std::size_t i)
                    { chunks[i] = gather(all, i, target_T_source, d2, evidence.cells.data() + all.chunk(i).first); });
  for (const InformationSums& chunk : chunks)  // in a fixed order
  {
    evidence.resistance += chunk.resistance.matrix();
    evidence.structure += chunk.structure.matrix();
    evidence.gauss_newton += chunk.gauss_newton.matrix();
    evidence.unsure_means += chunk.unsure_means.matrix();
  }
  return evidence;
}

/** On a cell at `arm` from the source's origin that is moved farther away by its deviation along the view. */
Vector3d forceOfDepth(const Symmetric3& weight, const TurnedCell& c, const Vector3d& arm)
{
  const Vector3d view = arm.normalized();
  const Matrix3d covariance = matrixOf({c.xx, c.xy, c.xz, c.yy, c.yz, c.zz});
  return matrixOf(weight) * view * std::sqrt(std::max(0.0, view.dot(covariance * view)));
}

/** Force and torque if that happens to all cells at once. */
Vector6d wrenchOfDepth(const CellCorrespondences& all, const Evidence& evidence, const Rigid& target_T_source)
{
  Vector6d wrench = Vector6d::Zero();
  for (std::size_t k = 0; k < all.chunks(); ++k)
  {
    const CellCorrespondences::Chunk& chunk = all.chunk(k);
    for (std::size_t i = 0; i < chunk.cells.size(); ++i)
    {
      if (chunk.ranges[i].count == 0) continue;
      const Vector3d arm = armOf(chunk.cells[i], target_T_source);
      const Vector3d force = forceOfDepth(evidence.cells[chunk.first + i].weight, chunk.cells[i], arm);
      wrench.head<3>() += force;
      wrench.tail<3>() += arm.cross(force);
    }
  }
  return wrench;
}

/** Sums over the cells within a few metres, whose errors are alike: leaves seen from one side, ground cut by a grid. */
struct Place
{
  Vector6d force = Vector6d::Zero();
  PoseSum curvature;  // of the score with B held
};

std::vector<Place> placesOf(const CellCorrespondences& all, const Evidence& evidence, const Rigid& target_T_source)
{
  const auto along = [](double v) { return static_cast<std::int64_t>(std::floor(v / fitted::kPlaceSize)); };
  KeyIndex index;
  std::vector<Place> places;
  for (std::size_t c = 0; c < all.chunks(); ++c)
    for (std::size_t i = 0; i < all.chunk(c).cells.size(); ++i)
    {
      if (all.chunk(c).ranges[i].count == 0) continue;
      const std::size_t cell = all.chunk(c).first + i;
      const Vector3d& mean = all.source()[cell].mean;
      const std::uint32_t place = index.placeOf(CellKey::of(along(mean.x()), along(mean.y()), along(mean.z())));
      if (place == places.size()) places.emplace_back();
      const PairInformation& pairs = evidence.cells[cell];
      const Vector3d v = armOf(all.chunk(c).cells[i], target_T_source), force(pairs.fx, pairs.fy, pairs.fz);
      places[place].force.head<3>() += force;
      places[place].force.tail<3>() += v.cross(force);
      places[place].curvature.add(pairs.pull, v.x(), v.y(), v.z());
    }
  return places;
}

/** targetOfStep() for steps in metres (see stepOfMetres). */
Matrix6d targetOfMetres(const Rigid& target_T_source)
{
  return targetOfStep(target_T_source) * stepOfMetres().asDiagonal();
}

/**
 * The curvature with no less than kLeastCurvature of the Gauss-Newton one in any direction. At a saddle, or where two
 * minima meet, the score is flat for a moment although its cells resist. A covariance of tens of metres is right there:
 * the scan counts for nothing. A viewpoint bias of tens of metres is not: it stays in what all registrations share
 * (SharedAttitudeNoise), and spoils the heading for the rest of the drive.
 */
Matrix6d withLeastCurvature(const Matrix6d& curvature, const Matrix6d& gauss_newton)
{
  const Matrix6d whole = gauss_newton + 1e-9 * (1 + gauss_newton.trace()) * Matrix6d::Identity();
  const Eigensystem6 shares = eigensystem(curvature, whole);
  Matrix6d raised = curvature;
  for (int i = 0; i < 6 && shares.values[i] < fitted::kLeastCurvature; ++i)
  {
    const Vector6d along = whole * shares.vectors.col(i);  // of unit length in the metric of `whole`
    raised += (fitted::kLeastCurvature - shares.values[i]) * along * along.transpose();
  }
  return raised;
}

/** The curvature may be indefinite far from a minimum: eigenvalues below a millionth of the largest are raised to it.
 */
Matrix6d safeInverse(const Matrix6d& symmetric)
{
  const auto [values, vectors] = eigensystem(symmetric);
  const double least = std::max(1e-12, 1e-6 * values[5]);
  return vectors * values.cwiseMax(least).cwiseInverse().asDiagonal() * vectors.transpose();
}

/**
 * The covariance in metres (see stepOfMetres); `bend` is the inverse of the curvature. It is the sandwich of the means'
 * noise, plus how far the pose moves when one place after the other is left out (the jackknife by clusters: J.
 * MacKinnon, M. Nielsen and M. Webb, Fast and reliable jackknife and bootstrap methods for cluster-robust inference,
 * Journal of Applied Econometrics 38, 2023).
 */
Matrix6d covarianceOf(const std::vector<Place>& places, const Matrix6d& curvature, const Matrix6d& bend,
                      const Matrix6d& unsure_means, const Matrix6d& target_of_step)
{
  const Matrix6d step_of_target = inverse(target_of_step);

  const auto movedWithout = [&](const Place& place) -> Vector6d
  {
    const Matrix6d others = curvature - place.curvature.matrix();
    if (const std::optional<Vector6d> target_moved = solvePositive(others, place.force))
      return step_of_target * *target_moved;
    return safeInverse(congruent(others, target_of_step)) * (target_of_step.transpose() * place.force);
  };
  std::vector<Vector6d> moved(places.size());
  const std::size_t grain = 32;  // places, about 30 us
  forAll(places.size(), grain, [&](std::size_t i) { moved[i] = movedWithout(places[i]); });

  Matrix6d covariance = bend * congruent(unsure_means, target_of_step) * bend;
  const double share = 1 - 1 / std::max<double>(1, static_cast<double>(places.size()));
  for (const Vector6d& by : moved) covariance += share * by * by.transpose();
  return covariance;
}

std::vector<GaussianCell> sampleOf(const std::vector<GaussianCell>& cells)
{
  const std::size_t enough = 1000;  // for a share of the score that is accurate to 0.015
  const std::size_t every = std::max<std::size_t>(1, cells.size() / enough);
  std::vector<GaussianCell> sample;
  for (std::size_t i = 0; i < cells.size(); i += every) sample.push_back(cells[i]);
  return sample;
}

/** The share of the score that is left after a long step; of a sample of cells, because each step looks up neighbours
 * anew. */
class ScoreAfterStep
{
 public:
  ScoreAfterStep(const CellCorrespondences& all, const Rigid& target_T_source, double d2)
    : sample_(sampleOf(all.source())),
      pairs_(all.targetMap(), sample_, all.sourceEdge(), all.neighbours()),
      from_(target_T_source),
      d2_(d2),
      here_(normalEquations(pairs_, from_, d2_).value)
  {
  }

  /** The larger share of those that the steps to both sides along `direction` keep. */
  double keptBy(const Vector6d& direction)
  {
    const Vector6d step = std::max(2.0, pairs_.sourceEdge()) * stepOfMetres().cwiseProduct(direction);
    const double there = std::min(normalEquations(pairs_, boxPlus(from_, step), d2_).value,
                                  normalEquations(pairs_, boxPlus(from_, -step), d2_).value);
    return here_ < 0 ? there / here_ : 1;
  }

 private:
  std::vector<GaussianCell> sample_;
  CellCorrespondences pairs_;
  Rigid from_;
  double d2_, here_;
};

/**
 * A direction is degenerate if the share of structure in the resistance against a step is below kDegenerate, or below
 * kDoubtful while a step of 2 m keeps kUnchangedScore.
 */
std::vector<Vector6d> degenerateAmong(const Evidence& evidence, const CellCorrespondences& all,
                                      const Rigid& target_T_source, double d2)
{
  const Matrix6d target_of_step = targetOfMetres(target_T_source);
  const Matrix6d structure = congruent(evidence.structure, target_of_step);
  Matrix6d resistance = congruent(evidence.resistance, target_of_step);
  resistance += 1e-9 * (1 + resistance.trace()) * Matrix6d::Identity();
  const Eigensystem6 shares = eigensystem(structure, resistance);
  std::optional<ScoreAfterStep> long_steps;
  std::vector<Vector6d> directions;
  for (int i = 0; i < 6 && shares.values[i] < fitted::kDoubtful; ++i)
  {
    Vector6d direction = shares.vectors.col(i).normalized();
    for (const Vector6d& before : directions) direction -= before.dot(direction) * before;
    direction.normalize();
    const bool is_bare = shares.values[i] < fitted::kDegenerate;
    if (!is_bare && !long_steps) long_steps.emplace(all, target_T_source, d2);
    if (is_bare || long_steps->keptBy(direction) > fitted::kUnchangedScore) directions.push_back(direction);
  }
  return directions;
}

Matrix6d inMetres(const Matrix6d& covariance)
{
  const Vector6d metres = stepOfMetres().cwiseInverse();
  return metres.asDiagonal() * covariance * metres.asDiagonal();
}
}  // namespace

Vector6d stepOfMetres()
{
  Vector6d scale;
  scale << 1, 1, 1, 1 / kArm, 1 / kArm, 1 / kArm;
  return scale;
}

double largestDeviation(const Matrix6d& covariance) { return std::sqrt(eigensystem(inMetres(covariance)).values[5]); }

std::vector<Vector6d> unmeasuredDirections(const Matrix6d& covariance)
{
  const Eigensystem6 of_metres = eigensystem(inMetres(covariance));
  std::vector<Vector6d> directions;
  for (int i = 5; i >= 0 && of_metres.values[i] > kOpen * kOpen; --i) directions.push_back(of_metres.vectors.col(i));
  return directions;
}

double scorePerInformation(double d2) { return d2 / fitted::kIndependentPoints; }

std::vector<Vector6d> degenerateDirections(const CellCorrespondences& all, const Rigid& target_T_source, double d2)
{
  return degenerateAmong(evidenceOf(all, target_T_source, d2), all, target_T_source, d2);
}

LidarInformation lidarInformation(const CellCorrespondences& all, const Rigid& target_T_source, double d2)
{
  const Evidence evidence = evidenceOf(all, target_T_source, d2);
  std::vector<Place> places;
  Vector6d wrench;
  LidarInformation information;
  tbb::parallel_invoke([&] { places = placesOf(all, evidence, target_T_source); },
                       [&] { wrench = wrenchOfDepth(all, evidence, target_T_source); },
                       [&] { information.degenerate = degenerateAmong(evidence, all, target_T_source, d2); });
  const Matrix6d target_of_step = targetOfMetres(target_T_source);
  Vector6d gradient = Vector6d::Zero();
  Matrix6d curvature = Matrix6d::Zero();
  for (const Place& place : places) gradient += place.force, curvature += place.curvature.matrix();
  information.gradient = targetOfStep(target_T_source).transpose() * gradient;
  information.curvature = congruent(curvature, targetOfStep(target_T_source));
  const Matrix6d bend = safeInverse(congruent(curvature, target_of_step));
  Matrix6d metres = fitted::kUnmodelled * covarianceOf(places, curvature, bend, evidence.unsure_means, target_of_step);
  // What no scan shows: the mean errors of ranges and of beam angles.
  const double rotation_floor = fitted::kRotationFloorDeg * M_PI / 180 * kArm;
  metres.diagonal().head<3>().array() += fitted::kTranslationFloor * fitted::kTranslationFloor;
  metres.diagonal().tail<3>().array() += rotation_floor * rotation_floor;

  const Matrix6d stiff = congruent(withLeastCurvature(curvature, evidence.gauss_newton), target_of_step);
  information.viewpoint_bias = -(safeInverse(stiff) * (target_of_step.transpose() * wrench)).head<3>();
  for (const Vector6d& direction : information.degenerate) metres += kOpen * kOpen * direction * direction.transpose();
  const Matrix6d symmetric = (metres + metres.transpose()) / 2;
  information.covariance = stepOfMetres().asDiagonal() * symmetric * stepOfMetres().asDiagonal();
  return information;
}
}  // namespace scanloom
