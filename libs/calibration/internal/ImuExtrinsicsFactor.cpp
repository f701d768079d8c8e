#include "calibration/internal/ImuExtrinsicsFactor.h"

#include <ceres/autodiff_cost_function.h>

namespace scanloom
{
namespace
{
template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

template <typename T>
Eigen::Quaternion<T> smallTurn(const Vector3<T>& turn)
{
  return Eigen::Quaternion<T>(T(1), T(0.5) * turn.x(), T(0.5) * turn.y(), T(0.5) * turn.z()).normalized();
}

struct Residual
{
  template <typename T>
  bool operator()(const T* state, const T* motion, const T* extrinsics, const T* tilt, const T* drift, const T* delay,
                  T* residuals) const
  {
    using Quaternion = Eigen::Quaternion<T>;
    using MapOfVector = Eigen::Map<const Vector3<T>>;
    using MapOfQuaternion = Eigen::Map<const Quaternion>;
    const Quaternion map_R_imu = MapOfQuaternion(state + 3) * smallTurn<T>(seen.turn_rate.cast<T>() * delay[0]);
    const Vector3<T> map_p_imu = MapOfVector(state) + MapOfVector(motion) * delay[0];
    const Quaternion map_R_body = map_R_imu * MapOfQuaternion(extrinsics + 3).conjugate();
    const Vector3<T> map_p_body = map_p_imu - map_R_body * MapOfVector(extrinsics);

    const Quaternion map_R_local = smallTurn<T>(Vector3<T>(tilt[0], tilt[1], T(0))) * seen.map_R_local.cast<T>();
    const Quaternion local_R_body = smallTurn<T>(MapOfVector(drift + 3)) * seen.local_T_body.rotation.cast<T>();
    const Quaternion seen_R_map = (map_R_local * local_R_body).conjugate();
    const Vector3<T> seen_p_map = map_R_local * (seen.local_T_body.translation.cast<T>() + MapOfVector(drift));

    const Quaternion turn = seen_R_map * map_R_body;
    Eigen::Matrix<T, 6, 1> error;
    error << seen_R_map * Vector3<T>(map_p_body - seen_p_map), (turn.w() < T(0) ? T(-2) : T(2)) * turn.vec();
    Eigen::Map<Eigen::Matrix<T, 6, 1>>{residuals} = seen.root.cast<T>() * error;
    return true;
  }

  SeenPose seen;
};
}  // namespace

std::unique_ptr<ceres::CostFunction> imuExtrinsicsFactor(const SeenPose& seen)
{
  return std::make_unique<ceres::AutoDiffCostFunction<Residual, 6, 7, 9, 7, 2, 6, 1>>(new Residual{seen});
}
}  // namespace scanloom
