#include "estimation/imu/NavState.h"

namespace scanloom
{
bool NavState::allFinite() const
{
  return map_T_imu.translation.allFinite() && map_T_imu.rotation.coeffs().allFinite() && velocity.allFinite() &&
         bias.gyro.allFinite() && bias.accel.allFinite();
}

NavState boxPlus(const NavState& state, const Vector15d& step)
{
  NavState moved = state;
  moved.map_T_imu = boxPlus(state.map_T_imu, Vector6d(step.head<6>()));
  moved.velocity += step.segment<3>(6);
  moved.bias.gyro += step.segment<3>(9);
  moved.bias.accel += step.segment<3>(12);
  return moved;
}

Vector15d boxMinus(const NavState& to, const NavState& from)
{
  Vector15d step;
  step << boxMinus(to.map_T_imu, from.map_T_imu), to.velocity - from.velocity, to.bias.gyro - from.bias.gyro,
      to.bias.accel - from.bias.accel;
  return step;
}
}  // namespace scanloom
