#pragma once
#include "base/core/ImuSample.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace scanloom
{
/** An IMU sample and its sensor: the lidar with that index, or the body's own IMU. */
struct SensorImu
{
  static constexpr int kBody = -1;
  int sensor = kBody;
  ImuSample sample;
};

/**
 * IMU samples in the time order of the columns: by (stamp, sensor). They are given out up to the batcher's horizon and
 * never hold a scan back; a sample that comes too late for its place is dropped and counted.
 */
class ImuOrder
{
 public:
  static constexpr std::size_t kMostWaiting = 100'000;  // until the first scan; then the oldest is dropped

  void add(const SensorImu&);

  /** Drops what this sensor has stamped later than `latest`; returns how many samples that were. */
  std::uint64_t dropAfter(int sensor, Timestamp latest);

  /** Moves the stamps of this sensor's samples that wait: its clock turned out to be another. */
  void shift(int sensor, Duration later);

  /** Samples of the body's IMU in time order, however far ahead of the packets. */
  void addBody(const std::vector<ImuSample>& samples) { body_.insert(body_.end(), samples.begin(), samples.end()); }

  /** The samples before `horizon`, in order. */
  std::vector<SensorImu> release(Timestamp horizon);

  std::uint64_t late() const { return late_; }
  std::uint64_t dropped() const { return dropped_; }

 private:
  std::deque<ImuSample> body_;
  std::deque<SensorImu> waiting_;
  Timestamp released_until_ = Timestamp::min();
  std::uint64_t late_ = 0, dropped_ = 0;
};
}  // namespace scanloom
