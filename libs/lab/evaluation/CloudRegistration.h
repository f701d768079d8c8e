/** Registration of two clouds on several levels of NDT cells, coarse to fine. */
#pragma once
#include "estimation/ndt/Registration.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace scanloom
{
struct PoseError
{
  double metres = 0, degrees = 0;
};

/** Norms of the translation and of the rotation from the truth to the estimate. */
PoseError poseError(const Rigid& estimate, const Rigid& truth);

/** A guess with these standard deviations of its translation and rotation, along and about every axis. */
PoseGuess guessWithin(const Rigid&, const PoseError& deviations);

struct TimedRegistration
{
  RegistrationResult result;
  double milliseconds = 0;
};

/** Makes the cells of both clouds once, for any number of guesses. */
class CloudPair
{
 public:
  using Points = std::vector<Eigen::Vector3f>;

  CloudPair(const Points& target, const Points& source);

  TimedRegistration registered(const PoseGuess&) const;

  /**
   * How far away another pose is that may be the true one; none within half a metre and 5 deg, and none where 99 % of
   * the source meet the target. It is that of the target in the source from the same guess, where less than half meets;
   * or one found from the guess turned by 90, 180 or 270 deg, because walls of a room meet four ways: one that agrees
   * better, or, where less than 90 % meet, nearly as well.
   */
  std::optional<PoseError> contradiction(const RegistrationResult&, const Rigid& guess) const;

  double targetMilliseconds() const { return target_.milliseconds; }  // to make the cells
  double sourceMilliseconds() const { return source_.milliseconds; }

 private:
  std::optional<PoseError> rivalAtAnotherHeading(const RegistrationResult&, const Rigid& guess) const;

  struct Prepared
  {
    std::vector<NdtMap> levels;
    double milliseconds;
  };
  static Prepared prepare(const Points&, const std::vector<double>& levels);

  Prepared target_, source_;
};
}  // namespace scanloom
