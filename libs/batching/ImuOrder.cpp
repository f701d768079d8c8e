#include "batching/ImuOrder.h"

#include <algorithm>
#include <tuple>

namespace scanloom
{
namespace
{
bool before(const SensorImu& a, const SensorImu& b)
{
  return std::tie(a.sample.stamp, a.sensor) < std::tie(b.sample.stamp, b.sensor);
}
}  // namespace

void ImuOrder::add(const SensorImu& imu)
{
  if (imu.sample.stamp < released_until_)
  {
    ++late_;
    return;
  }
  waiting_.insert(std::upper_bound(waiting_.begin(), waiting_.end(), imu, before), imu);
  if (waiting_.size() <= kMostWaiting) return;
  waiting_.pop_front();
  ++dropped_;
}

std::uint64_t ImuOrder::dropAfter(int sensor, Timestamp latest)
{
  const auto end =
      std::remove_if(waiting_.begin(), waiting_.end(),
                     [&](const SensorImu& imu) { return imu.sensor == sensor && imu.sample.stamp > latest; });
  const auto dropped = static_cast<std::uint64_t>(waiting_.end() - end);
  waiting_.erase(end, waiting_.end());
  return dropped;
}

std::vector<SensorImu> ImuOrder::release(Timestamp horizon)
{
  for (; !body_.empty() && body_.front().stamp < horizon; body_.pop_front()) add({SensorImu::kBody, body_.front()});
  released_until_ = std::max(released_until_, horizon);
  const auto end = std::partition_point(waiting_.begin(), waiting_.end(),
                                        [horizon](const SensorImu& imu) { return imu.sample.stamp < horizon; });
  std::vector<SensorImu> released(waiting_.begin(), end);
  waiting_.erase(waiting_.begin(), end);
  return released;
}
}  // namespace scanloom
