#include "input/rig/internal/ImuContinuity.h"

namespace scanloom
{
namespace
{
/** Packets of one sample without ids, no IMU's quicker than this. */
LidarDescription asLidarWithoutIds()
{
  LidarDescription imu;
  imu.numbering = Numbering::Stamps;
  imu.columns_per_packet = 1;
  imu.frame_rate = 10;
  imu.fixed_block_period = 100us;
  return imu;
}
}  // namespace

ImuContinuity::ImuContinuity() : continuity_(asLidarWithoutIds()) {}

bool ImuContinuity::accepts(Timestamp stamp, Timestamp received, std::optional<Duration> ahead)
{
  if (!isPlausible(stamp, received)) return false;
  if (ahead) return std::chrono::abs(*ahead) <= kArrivalTolerance;
  return continuity_.judge({std::nullopt, 0, 0, stamp}, received).verdict != Continuity::Verdict::Doubtful;
}
}  // namespace scanloom
