#pragma once
#include "source/CaptureClock.h"
#include "source/RigInput.h"

#include <deque>

namespace scanloom
{
/**
 * A rig's datagrams in, its IMU samples and scans out: the one way from packets to scans, for captures and sockets
 * alike.
 *
 * The batcher is told of time at whole milliseconds and of nothing between, each before the datagrams that were
 * received after it: so live and replay, which learn of time in different steps, take the very same steps. What comes
 * out depends on the datagrams and their receive times alone (but for empty scans after the last one).
 */
class RigStream
{
 public:
  enum class ReceiveTimes
  {
    Steady,
    OfCapture,  // the clock may have been set meanwhile, see CaptureClock
  };

  RigStream(const Rig&, ReceiveTimes);
  RigStream(const RigStream&) = delete;
  RigStream& operator=(const RigStream&) = delete;

  /** In the order of receive times, as far as possible. Throws what PacketRouter::route and Batcher::push throw. */
  void take(const DatagramView&);

  /** Every datagram received before `now` was taken. */
  void advance(Timestamp now);

  /** More of the body's IMU, later than what the rig has; before the datagrams that were received after it. */
  void takeBodyImu(const std::vector<ImuSample>&);

  /** The latest time that the batcher was told of: no datagram should be received before it. */
  Timestamp time() const { return time_; }

  /** No more datagrams: all that waits comes out. */
  void finish();

  /** The lidar is another one from here on, or is known at last. */
  void replace(LidarIndex, std::shared_ptr<const PacketDecoder>, const LidarAddress&);

  /** Lidars that started anew, or sent packets that fit neither their decoder nor what came before, since the last
   * call. */
  std::vector<LidarIndex> takeDoubted();

  /** The next event that is ready. */
  std::optional<SensorEvent> next();

  /** The batcher's notices since the last call, as lines of text. */
  std::vector<std::string> takeWarnings();

  /** Without `input`, which the stream does not know. */
  RigAccount account() const;

  const Batcher& batcher() const { return *batcher_; }
  const PacketRouter& router() const { return router_; }
  std::uint64_t lateImuSamples() const { return imu_order_.late(); }

 private:
  Timestamp steadyTimeOf(const DatagramView&, const Routed&);
  void release(std::vector<Scan> scans);
  void releaseImu(Timestamp horizon);
  void releaseParts(Timestamp end);

  std::vector<BatchedLidar> lidars_;
  std::deque<ImuSample> body_imu_;  // to come
  PacketRouter router_;
  std::optional<CaptureClock> capture_clock_;
  std::uint64_t capture_clock_steps_ = 0;  // as of takeWarnings()
  std::vector<MeasurementBlock> blocks_;
  std::unique_ptr<Batcher> batcher_;
  Duration imu_patience_;
  Duration longest_effect_;  // of one silence on the batcher: after it, one step is as good as many
  Timestamp time_ = Timestamp::min();
  ImuOrder imu_order_;
  std::deque<ScanPart> parts_;  // on their way from the batcher
  std::deque<SensorEvent> ready_;
  std::vector<std::uint64_t> strange_;  // packets per lidar that fit nothing, as of takeDoubted()
  std::vector<LidarIndex> restarted_;
};
}  // namespace scanloom
