#include "estimation/graph/StateBlocks.h"

namespace scanloom
{
StateBlocks blocksOf(const NavState& state)
{
  StateBlocks blocks;
  blocks.pose = blockOf(state.map_T_imu);
  blocks.motion << state.velocity, state.bias.gyro, state.bias.accel;
  return blocks;
}

NavState stateOf(const double* pose, const double* motion, Timestamp stamp)
{
  const Eigen::Map<const MotionBlock> m(motion);
  return {stamp, poseOf(pose), m.head<3>(), {m.segment<3>(3), m.tail<3>()}};
}
}  // namespace scanloom
