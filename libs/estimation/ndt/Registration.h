/**
 * Distribution-to-distribution NDT registration (T. Stoyanov: Reliable autonomous navigation in semi-structured
 * environments using the 3D-NDT, PhD thesis, Orebro 2012, chapter 6). The equations are in doc/registration.md.
 */
#pragma once
#include "base/core/Rigid.h"
#include "estimation/ndt/NdtMap.h"

#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct RegistrationOptions
{
  double first_d2 = 0.015;  // d2 of the first steps, for guesses that are far from the pose
  double d2 = 0.4;          // width of the score's Gaussian, exp(-d2/2 m'Bm): larger is narrower (Stoyanov 2012: 0.05)
  int max_iterations = 30;  // at most this many steps
  double tolerance =
      3e-4;  // m: how far the result may be from the minimum (a rotation counts as the motion of a point 5 m away)
  int neighbours = 27;       // target cells compared with each source cell: 1, 7 or 27
  double min_overlap = 0.3;  // smallest share of the source's points in cells that match a target cell
  double rival_share =
      0.8;  // another pose with this share of the best score is a rival (for guesses with a covariance)
};

enum class Outcome
{
  Converged,
  IterationLimit,
  LowOverlap,  // too little of the source matches the target: do not trust the pose
  Degenerate,  // some direction has no information: the pose was not moved along it
};
std::string toString(Outcome);

struct RegistrationResult
{
  Rigid target_T_source;
  Matrix6d information = Matrix6d::Zero();  // of the lidar alone, in the tangent of boxPlus (source frame)
  Matrix6d covariance = Matrix6d::Zero();   // its inverse; both are zero without a single pair of cells
  /**
   * m, along the source's axes: how far the pose would move if each cell of the source lay farther from the source's
   * origin by its own deviation along the view. A lidar sees the near side of leaves and bark, so that means are nearer
   * than what they stand for; this is near zero where that cancels because the same is seen on all sides.
   */
  Eigen::Vector3d viewpoint_bias{0, 0, 0};
  double score = 0;    // Stoyanov's objective per source cell, negative
  double overlap = 0;  // share of the source's points in cells that match a target cell
  int iterations = 0;
  Outcome outcome = Outcome::LowOverlap;
  /** Orthonormal steps (m, m, m, and rad times 5 m) that no structure resists; their deviation in covariance is 10 m.
   */
  std::vector<Vector6d> degenerate_directions;
  /**
   * Other poses within the guess's covariance where the clouds agree as well. Of all these, target_T_source is the one
   * nearest to the guess. The directions to the others are degenerate; their deviations are the distances.
   */
  std::vector<Rigid> rivals;

  bool trustworthy() const { return outcome == Outcome::Converged || outcome == Outcome::IterationLimit; }
};

/** The pose as it is known before the registration, from an IMU, a map or a person. */
struct PoseGuess
{
  PoseGuess(const Rigid& pose) : target_T_source(pose) {}  // with unknown errors
  /** Covariance of boxMinus(truth, pose); throws std::invalid_argument unless it is positive definite. */
  PoseGuess(const Rigid& pose, const Matrix6d& covariance);

  Rigid target_T_source;
  std::optional<Matrix6d> covariance;
};

/**
 * Finds target_T_source from a guess: first with the wide score, then from there with the narrow one, whose minimum is
 * sharper. A guess with a covariance is part of the objective, so that it determines the directions that the clouds
 * leave open. The result's information is that of the clouds alone. The same input gives the same bits.
 */
RegistrationResult align(const NdtMap& target, const NdtMap& source, const PoseGuess&, const RegistrationOptions&);

struct RegistrationLevel
{
  const NdtMap& target;
  const NdtMap& source;
};

/** References to both. Throws std::invalid_argument unless there are as many sources as targets. */
std::vector<RegistrationLevel> pairLevels(const std::vector<NdtMap>& targets, const std::vector<NdtMap>& sources);

/**
 * Aligns level by level, coarse cells first, for a wider basin with the accuracy of the last level. Begins at the level
 * whose cells fit the guess's covariance, or at the coarsest one for a guess without. Before the first level of 4 m or
 * less, unless that is the last, headings up to 25 deg away are tried within the guess's covariance. A level that ends
 * in LowOverlap does not change the pose. The result is the last level's, with the iterations of all. Throws
 * std::invalid_argument without a level.
 */
RegistrationResult alignCoarseToFine(const std::vector<RegistrationLevel>&, const PoseGuess&,
                                     const RegistrationOptions&);
}  // namespace scanloom
