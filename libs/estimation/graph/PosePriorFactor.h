#pragma once
#include "estimation/graph/internal/PoseManifold.h"

#include <ceres/sized_cost_function.h>

namespace scanloom
{
/**
 * A measured pose of the body in the map; the state is the IMU's. Six whitened residuals
 * boxMinus(map_T_imu * imu_T_body, measured). Block: the state's pose.
 *
 * Also for a pose relative to a keyframe that does not move: boxMinus is the same in every frame, so pass
 * map_T_keyframe * keyframe_T_body with the same information.
 */
class PosePriorFactor final : public ceres::SizedCostFunction<6, 7>
{
 public:
  /** The information's tangent is that of boxPlus at map_T_body; it may be singular. */
  PosePriorFactor(const Rigid& map_T_body, const Matrix6d& information, const Rigid& body_T_imu);

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  Rigid map_T_body_;
  Rigid imu_T_body_;
  Matrix6d root_;  // of the information
};

/** Derivative of the body's step by a step of the IMU, each in its own frame. */
Matrix6d bodyStepByImuStep(const Rigid& imu_T_body);

/** The covariance of a step of frame `a`, as one of a step of frame `b` that is fixed to it; tangents of boxPlus. */
Matrix6d movedTo(const Rigid& a_T_b, const Matrix6d& covariance);
}  // namespace scanloom
