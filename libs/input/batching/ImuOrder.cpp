#include "input/batching/ImuOrder.h"

#include <algorithm>
#include <iterator>
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

void ImuOrder::shift(int sensor, Duration later)
{
  const auto of_others = std::stable_partition(waiting_.begin(), waiting_.end(),
                                               [&](const SensorImu& imu) { return imu.sensor != sensor; });
  std::vector<SensorImu> shifted(of_others, waiting_.end());
  waiting_.erase(of_others, waiting_.end());
  for (SensorImu& imu : shifted)
  {
    imu.sample.stamp += later;
    add(imu);
  }
}

std::vector<SensorImu> ImuOrder::release(Timestamp horizon)
{
  released_until_ = std::max(released_until_, horizon);
  std::vector<SensorImu> body;
  for (; !body_.empty() && body_.front().stamp < horizon; body_.pop_front())
    body.push_back({SensorImu::kBody, body_.front()});
  const auto end = std::partition_point(waiting_.begin(), waiting_.end(),
                                        [horizon](const SensorImu& imu) { return imu.sample.stamp < horizon; });
  std::vector<SensorImu> released;
  released.reserve(body.size() + static_cast<std::size_t>(end - waiting_.begin()));
  std::merge(body.begin(), body.end(), waiting_.begin(), end, std::back_inserter(released), before);
  waiting_.erase(waiting_.begin(), end);
  return released;
}
}  // namespace scanloom
