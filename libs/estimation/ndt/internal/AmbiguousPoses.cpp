#include "estimation/ndt/internal/AmbiguousPoses.h"

#include "base/core/Decompositions.h"
#include "estimation/ndt/FittedConstants.h"
#include "estimation/ndt/Minimiser.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
/** Shifts in the source's frame, m: whole steps within an ellipse of three deviations. */
struct Shifts
{
  int most_along_first, most_along_second;
  Eigen::Vector3d first, second;  // one step

  Eigen::Vector3d at(int i, int j) const { return i * first + j * second; }
  bool inside(int i, int j) const
  {
    const double a = i / (most_along_first + 0.5), b = j / (most_along_second + 0.5);
    return a * a + b * b <= 1;
  }
};

/** As far as the guess allows, along the two directions that the clouds determine least: not into the ground. */
Shifts shiftsOf(const Eigen::Matrix3d& guess, const Eigen::Matrix3d& clouds, double step)
{
  const Eigensystem3 eigen = eigensystem3(clouds);
  const Eigen::Vector3d first = eigen.vectors.col(2), second = eigen.vectors.col(1);
  const auto most = [&](const Eigen::Vector3d& along)
  {
    const double reach = 3 * std::sqrt(along.dot(guess * along));
    return static_cast<int>((reach < 5 ? reach : 5) / step);
  };
  return {most(first), most(second), step * first, step * second};
}

Rigid moved(const Rigid& pose, const Eigen::Vector3d& by) { return pose * Rigid{Eigen::Quaterniond::Identity(), by}; }

/** The score at every shift of a rectangle; 0 outside the ellipse. */
class Scores
{
 public:
  /** `scoreAt`: of a shift. */
  template <typename ScoreAt>
  Scores(const Shifts& shifts, ScoreAt&& scoreAt) : shifts_(shifts)
  {
    for (int i = -shifts.most_along_first; i <= shifts.most_along_first; ++i)
      for (int j = -shifts.most_along_second; j <= shifts.most_along_second; ++j)
        values_.push_back(shifts.inside(i, j) ? scoreAt(shifts.at(i, j)) : 0);
  }

  double at(int i, int j) const
  {
    if (std::abs(i) > shifts_.most_along_first || std::abs(j) > shifts_.most_along_second) return 0;
    const int row = 2 * shifts_.most_along_second + 1;
    return values_[static_cast<std::size_t>((i + shifts_.most_along_first) * row + j + shifts_.most_along_second)];
  }

  bool isMaximum(int i, int j) const
  {
    for (int k = -1; k <= 1; ++k)
      for (int l = -1; l <= 1; ++l)
        if ((k != 0 || l != 0) && at(i + k, j + l) > at(i, j)) return false;
    return true;
  }

 private:
  Shifts shifts_;
  std::vector<double> values_;
};
}  // namespace

double mahalanobisDistance(const PoseGuess& guess, const Rigid& pose)
{
  const Vector6d off = boxMinus(pose, guess.target_T_source);
  return off.dot(*solvePositive(*guess.covariance, off));
}

std::vector<Rigid> ambiguousPoses(const RegistrationLevel& level, const RegistrationResult& result,
                                  const PoseGuess& guess, const RegistrationOptions& options)
{
  const double step = level.source.options().cell_size;
  if (!guess.covariance) return {};
  const Shifts shifts =
      shiftsOf(guess.covariance->topLeftCorner<3, 3>(), result.covariance.topLeftCorner<3, 3>(), step);
  if (std::max(shifts.most_along_first, shifts.most_along_second) < 2) return {};

  const Rigid& best = result.target_T_source;
  // With the rotation of the best pose, because rows of stems are parallel.
  const Rigid centre{best.rotation, guess.target_T_source.translation};
  CellCorrespondences correspondences(level.target, level.source, options.neighbours);
  const double broad = -normalEquations(correspondences, best, fitted::kBroadD2).value;
  const double narrow = -normalEquations(correspondences, best, options.d2).value;
  const Scores scores(shifts, [&](const Eigen::Vector3d& shift)
                      { return -normalEquations(correspondences, moved(centre, shift), fitted::kBroadD2).value; });
  RegistrationOptions wide = options;
  wide.d2 = fitted::kBroadD2;
  std::vector<Rigid> rivals;
  for (int i = -shifts.most_along_first; i <= shifts.most_along_first; ++i)
    for (int j = -shifts.most_along_second; j <= shifts.most_along_second; ++j)
    {
      if (scores.at(i, j) < fitted::kRivalCandidate * broad || !scores.isMaximum(i, j)) continue;
      const Minimum near = minimise(correspondences, moved(centre, shifts.at(i, j)), {}, wide, {});
      const Minimum there = minimise(correspondences, near.target_T_source, {}, options, {});
      const double apart = boxMinus(there.target_T_source, best).head<3>().norm();
      if (apart > step && -there.equations.value >= options.rival_share * narrow)
        rivals.push_back(there.target_T_source);
    }
  return rivals;
}
}  // namespace scanloom
