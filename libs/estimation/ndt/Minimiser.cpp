#include "estimation/ndt/Minimiser.h"

#include "base/core/Decompositions.h"
#include "estimation/ndt/FittedConstants.h"
#include "estimation/ndt/LidarInformation.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
using Pairs = std::vector<CellCorrespondences*>;

NormalEquations at(const Rigid& pose, const Pairs& pairs, const PosePrior& prior, double d2)
{
  NormalEquations sum;
  for (CellCorrespondences* correspondences : pairs)
  {
    const NormalEquations one = normalEquations(*correspondences, pose, d2);
    sum.value += one.value;
    sum.gradient += one.gradient;
    sum.curvature += one.curvature;
    sum.met_points += one.met_points;
  }
  return prior.addedTo(sum, pose, d2);
}

/** The step in metres, within the range of the projector `free`. */
Vector6d dampedStep(const NormalEquations& equations, double damping, const Matrix6d& free)
{
  const Vector6d scale = stepOfMetres();
  const Matrix6d curvature = scale.asDiagonal() * equations.curvature * scale.asDiagonal();
  const Matrix6d identity = Matrix6d::Identity();
  const Matrix6d damped =
      free * curvature * free + curvature.trace() * ((identity - free) + (damping + 1e-9) * identity);
  return -free * damped.ldlt().solve(free * scale.cwiseProduct(equations.gradient));
}

/**
 * The ratio of one step to the last; 0 where they are not parallel. Without the turning of B and the score's second
 * derivative the curvature is too large, so each step is about the same fraction of the one before it: the sum of all
 * further steps follows from two.
 */
double shrinkingOf(const Vector6d& step, const Vector6d& before)
{
  const double along = step.dot(before);
  if (!(along > fitted::kParallelSteps * step.norm() * before.norm())) return 0;
  return std::min(fitted::kMostShrinking, along / before.squaredNorm());
}

Minimum minimise(const Pairs& pairs, const Rigid& start, const PosePrior& prior, const RegistrationOptions& options,
                 const std::vector<Vector6d>& locked)
{
  Matrix6d free = Matrix6d::Identity();
  for (const Vector6d& direction : locked) free -= direction * direction.transpose();

  Minimum here{start, at(start, pairs, prior, options.d2), 0, false};
  double damping = 0;
  Vector6d before = Vector6d::Zero();  // the last step; zero if the next is not comparable with it
  while (here.equations.met_points > 0 && here.iterations < options.max_iterations)
  {
    ++here.iterations;
    const Vector6d plain = dampedStep(here.equations, damping, free);
    const double shrinking = shrinkingOf(plain, before);
    const Vector6d step = plain / (1 - shrinking);
    before = shrinking == 0 ? plain : Vector6d::Zero();

    const Rigid candidate = boxPlus(here.target_T_source, stepOfMetres().cwiseProduct(step));
    if (step.norm() < options.tolerance)  // too small to evaluate all cells again
    {
      here.target_T_source = candidate;
      here.converged = true;
      break;
    }
    const NormalEquations there = at(candidate, pairs, prior, options.d2);
    // Steps follow the gradient with B held constant. Its zero is not quite the minimum of the score with B turning
    // (which rewards turns that only enlarge B^-1, and leads to worse poses), so near it the score may rise a little.
    if (there.value <= here.equations.value + fitted::kScoreSlack * std::abs(here.equations.value))
    {
      here.target_T_source = candidate;
      here.equations = there;
      damping = damping > 1e-4 ? damping / 10 : 0;
    }
    else
    {
      damping = std::max(10 * damping, 1e-3);
    }
  }
  for (CellCorrespondences* correspondences : pairs) correspondences->moveTo(here.target_T_source);
  return here;
}
}  // namespace

PosePrior::PosePrior(const PoseGuess& guess) : pose_(guess.target_T_source)
{
  if (guess.covariance) information_ = inverse(*guess.covariance);
}

NormalEquations PosePrior::addedTo(NormalEquations equations, const Rigid& target_T_source, double d2) const
{
  if (information_.isZero(0)) return equations;
  // The Jacobian of boxMinus is taken as the identity: an error of 5 % at 6 degrees.
  const Vector6d off = boxMinus(target_T_source, pose_);
  const Matrix6d weight = scorePerInformation(d2) * information_;
  equations.value += 0.5 * off.dot(weight * off);
  equations.gradient += weight * off;
  equations.curvature += weight;
  return equations;
}

Minimum minimise(CellCorrespondences& correspondences, const Rigid& start, const PosePrior& prior,
                 const RegistrationOptions& options, const std::vector<Vector6d>& locked)
{
  return minimise(Pairs{&correspondences}, start, prior, options, locked);
}

Minimum minimise(std::vector<CellCorrespondences> all, const Rigid& start, const RegistrationOptions& options)
{
  Pairs pairs;
  for (CellCorrespondences& correspondences : all) pairs.push_back(&correspondences);
  return minimise(pairs, start, {}, options, {});
}
}  // namespace scanloom
