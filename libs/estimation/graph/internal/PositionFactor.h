#pragma once
#include "estimation/graph/internal/PoseManifold.h"

#include <ceres/sized_cost_function.h>

namespace scanloom
{
/** A measured position of a point that is fixed to the body: three whitened residuals. Block: the body's pose. */
class PositionFactor final : public ceres::SizedCostFunction<3, 7>
{
 public:
  /** `covariance`: positive definite, m2. */
  PositionFactor(const Eigen::Vector3d& body_p_point, const Eigen::Vector3d& map_p_point,
                 const Eigen::Matrix3d& covariance);

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  Eigen::Vector3d body_p_point_, map_p_point_;
  Eigen::Matrix3d root_;  // of the information
};
}  // namespace scanloom
