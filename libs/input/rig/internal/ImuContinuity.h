#pragma once
#include "input/batching/Continuity.h"

namespace scanloom
{
/**
 * Decides whether samples of a lidar's IMU are of that IMU: by the lidar's clock, which stamps both, or while the lidar
 * is not seen in the samples before, as for lidar packets without ids.
 */
class ImuContinuity
{
 public:
  ImuContinuity();

  /** @param ahead of the lidar's clock, as Continuity::ahead. */
  bool accepts(Timestamp stamp, Timestamp received, std::optional<Duration> ahead);

 private:
  Continuity continuity_;
};
}  // namespace scanloom
