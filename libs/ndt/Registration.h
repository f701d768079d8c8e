/**
 * Distribution-to-distribution NDT registration (T. Stoyanov: Reliable autonomous navigation in semi-structured
 * environments using the 3D-NDT, PhD thesis, Orebro 2012, chapter 6). The equations are in doc/registration.md.
 */
#pragma once
#include "core/Field.h"
#include "core/Rigid.h"
#include "ndt/NdtMap.h"

#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct RegistrationOptions
{
  double first_d2 = 0.015;
  double d2 = 0.4;  // eight times as narrow as Stoyanov 2012
  int max_iterations = 30;
  double tolerance = 3e-4;
  int neighbours = 27;
  double min_overlap = 0.3;
  double rival_share = 0.8;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.first_d2, Field{"first_d2", "", "d2 of the first steps, for guesses that are far off", above(0)});
    visit(o.d2, Field{"d2", "", "width of the score's Gaussian: exp(-d2/2 m'Bm)", above(0)});
    visit(o.max_iterations, Field{"max_iterations", "", "steps at most", between(1, 1000)});
    visit(o.tolerance,
          Field{"tolerance", "m", "a step below this ends the search (rotations count by a 5 m arm)", above(0)});
    visit(o.neighbours, Field{"neighbours", "", "target cells looked at per source cell: 1, 7 or 27", between(1, 27)});
    visit(o.min_overlap,
          Field{"min_overlap", "", "least share of the source's points that must meet the target", between(0, 1)});
    visit(o.rival_share,
          Field{"rival_share", "",
                "share of the best score that makes another pose a rival (guesses with a covariance)", between(0, 1)});
  }
};

enum class Outcome
{
  Converged,
  IterationLimit,
  LowOverlap,  // too little of the source met the target: the pose is not to be trusted
  Degenerate,  // some direction has no information: it was not moved
};
std::string toString(Outcome);

struct RegistrationResult
{
  Rigid target_T_source;
  Matrix6d information =
      Matrix6d::Zero();  // of the lidar alone; tangent of boxPlus: translation, rotation in the source frame
  Matrix6d covariance = Matrix6d::Zero();  // its inverse; both are zero without a single pair of cells
  double score = 0;                        // Stoyanov's objective, per source cell, negative
  double overlap = 0;  // share of the source's points in cells that meet a target cell within the score's reach
  int iterations = 0;
  Outcome outcome = Outcome::LowOverlap;
  /** Orthonormal steps (m, m, m, and rad times the arm of 5 m) that no structure resists; 10 m uncertain in covariance.
   */
  std::vector<Vector6d> degenerate_directions;
  /**
   * Other poses within the guess's covariance where the clouds agree as well. target_T_source is the one of them all
   * that surprises the guess least; the ways to the others are degenerate directions, as uncertain as they are long.
   */
  std::vector<Rigid> rivals;

  bool trustworthy() const { return outcome == Outcome::Converged || outcome == Outcome::IterationLimit; }
  std::string brief() const;  // one line for a person
};

/** Where the source is thought to be before it is looked at: by an IMU, a map or a person. */
struct PoseGuess
{
  PoseGuess(const Rigid& pose) : target_T_source(pose) {}  // nothing known about its errors
  /** Covariance of boxMinus(truth, pose); throws std::invalid_argument unless it is positive definite. */
  PoseGuess(const Rigid& pose, const Matrix6d& covariance);

  Rigid target_T_source;
  std::optional<Matrix6d> covariance;
};

/**
 * Finds target_T_source from a guess: by a wide score first, from there by the narrow one, whose minimum is sharper. A
 * guess with a covariance is part of what is minimised, so that it holds what the clouds leave open; the result's
 * information is the clouds' alone all the same. Values in, values out: the same input gives the same bits.
 */
RegistrationResult align(const NdtMap& target, const NdtMap& source, const PoseGuess&, const RegistrationOptions&);

struct RegistrationLevel
{
  const NdtMap& target;
  const NdtMap& source;
};

/** Level by level, without copies. Throws std::invalid_argument unless there are as many of one as of the other. */
std::vector<RegistrationLevel> pairLevels(const std::vector<NdtMap>& targets, const std::vector<NdtMap>& sources);

/**
 * One level after the other, coarse cells first: wider basin, and the accuracy of the last level. It begins at the
 * level whose cells fit the guess's covariance, at the coarsest one without. Before the first level of 4 m or less, if
 * it is not the last, headings up to 25 deg away are tried as far as the guess leaves them open. A level that ends in
 * LowOverlap leaves the pose as it was. The result is the last level's, its iterations are those of all. Throws
 * std::invalid_argument without a level.
 */
RegistrationResult alignCoarseToFine(const std::vector<RegistrationLevel>&, const PoseGuess&,
                                     const RegistrationOptions&);
}  // namespace scanloom
