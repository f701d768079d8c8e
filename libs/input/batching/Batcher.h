#pragma once
#include "input/batching/Counters.h"
#include "input/batching/RoutedPacket.h"
#include "input/batching/Scan.h"
#include "input/batching/internal/BatcherOptions.h"
#include "input/batching/internal/Notice.h"

#include <memory>
#include <optional>
#include <vector>

namespace scanloom
{
/** Packets of several lidars in, scans out: TimeBatcher, or WholeTurns to compare it with. */
class Batcher
{
 public:
  virtual ~Batcher() = default;

  /** Scans completed by this packet, oldest first. IMU packets are not for here: see ImuOrder. */
  virtual std::vector<Scan> push(RoutedPacket) = 0;

  /** Scans completed because time has passed without a packet. */
  virtual std::vector<Scan> advance(Timestamp now) = 0;

  /** No more packets will come: everything that waits is given out. */
  virtual std::vector<Scan> finish() = 0;

  /** Called in push, advance and finish for each slice as soon as it is complete: see ScanSlice. */
  virtual void onSlice(SliceSink) = 0;

  /** The lidar's packets have another format from here on, or a known one at last. Waiting ones keep their decoder. */
  virtual void replace(LidarIndex, std::shared_ptr<const PacketDecoder>) = 0;

  /** No column to come has an earlier stamp; none before the first scan starts. */
  virtual std::optional<Timestamp> horizon() const = 0;

  /** What is added to this lidar's stamps at present, also to those of its IMU. */
  virtual Duration timeOffset(LidarIndex) const = 0;

  /**
   * How far ahead a stamp of this lidar's own clock, say of its IMU, is of what the clock showed when it was received.
   * None while the lidar was not heard, or where host time is not used.
   */
  virtual std::optional<Duration> ahead(LidarIndex, Timestamp stamp, Timestamp received) const = 0;

  /** What a person should know, since the last call. */
  virtual std::vector<Notice> takeNotices() = 0;

  virtual const LidarCounters& counters(LidarIndex) const = 0;

  /** With the decoders in use. */
  virtual const std::vector<BatchedLidar>& lidars() const = 0;

 protected:
  Batcher() = default;
  Batcher(const Batcher&) = default;
  Batcher(Batcher&&) = default;
  Batcher& operator=(const Batcher&) = default;
  Batcher& operator=(Batcher&&) = default;
};
}  // namespace scanloom
