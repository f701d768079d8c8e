#pragma once
#include "core/ImuSample.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
/** An IMU sample and whose it is: the lidar with that index, or the body's own IMU. */
struct SensorImu
{
  static constexpr int kBody = -1;
  int sensor = kBody;
  ImuSample sample;
};

/**
 * IMU samples in the time order of the columns: by (stamp, sensor). They follow the batcher's horizon and never hold a
 * scan back; one that comes after its place has been given out is refused and counted.
 */
class ImuOrder
{
 public:
  void add(const SensorImu&);

  /** The samples before `horizon`, in order. */
  std::vector<SensorImu> release(Timestamp horizon);

  std::uint64_t late() const { return late_; }

 private:
  std::vector<SensorImu> waiting_;
  Timestamp released_until_ = Timestamp::min();
  std::uint64_t late_ = 0;
};
}  // namespace scanloom
