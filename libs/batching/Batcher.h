#pragma once
#include "batching/BatcherOptions.h"
#include "batching/Counters.h"
#include "batching/Notice.h"
#include "batching/Scan.h"
#include "core/Bytes.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace scanloom
{
/** Packets of several lidars in, scans out: TimeBatcher, or WholeTurns to compare it with. */
class Batcher
{
 public:
  using SliceSink = std::function<void(const ScanSlice&)>;

  virtual ~Batcher() = default;

  /**
   * Scans completed by this packet, oldest first. `received` is the host's (or the capture's record) time. IMU packets
   * are not for here: see ImuOrder.
   */
  virtual std::vector<Scan> push(LidarIndex, Bytes packet, Timestamp received) = 0;

  /** Time has passed without a packet. */
  virtual std::vector<Scan> advance(Timestamp now) = 0;

  /** No more packets: everything that waits comes out. */
  virtual std::vector<Scan> finish() = 0;

  /** Called in push, advance and finish for each slice as soon as it is complete: see ScanSlice. */
  virtual void onSlice(SliceSink) = 0;

  /** The lidar is another one from here on, or is known at last; what waits is still read by the old decoder. */
  virtual void replace(LidarIndex, std::shared_ptr<const PacketDecoder>) = 0;

  /** The memory of a scan that nobody needs any more, for those to come. */
  virtual void recycle(Scan&&) = 0;

  /** No column to come is older than this stamp; none at the start. */
  virtual std::optional<Timestamp> horizon() const = 0;

  /** What is added to this lidar's stamps at present, its IMU's included. */
  virtual Duration timeOffset(LidarIndex) const = 0;

  /** What a person should hear of, since the last call. */
  virtual std::vector<Notice> takeNotices() = 0;

  virtual const LidarCounters& counters(LidarIndex) const = 0;
  virtual const std::vector<BatchedLidar>& lidars() const = 0;

 protected:
  Batcher() = default;
  Batcher(const Batcher&) = default;
  Batcher(Batcher&&) = default;
  Batcher& operator=(const Batcher&) = default;
  Batcher& operator=(Batcher&&) = default;
};

/**
 * As options.batching says. Throws std::invalid_argument for another name and for slices of whole turns, and what the
 * constructors throw.
 */
std::unique_ptr<Batcher> makeBatcher(const std::vector<BatchedLidar>&, const BatcherOptions&);
}  // namespace scanloom
