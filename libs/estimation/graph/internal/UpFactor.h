#pragma once
#include "estimation/graph/internal/PoseManifold.h"

#include <ceres/sized_cost_function.h>

namespace scanloom
{
/**
 * Which way is up in the frame of a pose: residual of three numbers, the cross product of the pose's own up and the
 * measured one, over sigma. It says nothing about the heading. Block: the pose.
 */
class UpFactor final : public ceres::SizedCostFunction<3, 7>
{
 public:
  /** `body_up`: unit vector. `sigma`: rad. */
  UpFactor(const Eigen::Vector3d& body_up, double sigma) : body_up_(body_up), sigma_(sigma) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  Eigen::Vector3d body_up_;
  double sigma_;
};
}  // namespace scanloom
