#pragma once
#include "input/batching/ImuOrder.h"
#include "input/batching/TimeBatcher.h"
#include "input/rig/PacketRouter.h"
#include "input/rig/Rig.h"
#include "input/rig/SensorInput.h"
#include "input/rig/internal/CaptureClock.h"
#include "input/rig/internal/ImuContinuity.h"

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * A rig's datagrams in, its IMU samples and scans out: the only way from packets to scans, for captures and sockets.
 *
 * The batcher's time advances in whole milliseconds, each before the datagrams that were received after it. Live input
 * and replay learn of time in different steps; this way they give the batcher the same ones. So the result depends on
 * the datagrams and their receive times alone (except for empty scans after the last one).
 */
class RigStream
{
 public:
  enum class ReceiveTimes
  {
    Steady,
    OfCapture,  // the computer's clock may have been set meanwhile, see CaptureClock
  };

  RigStream(const Rig&, ReceiveTimes);
  RigStream(const RigStream&) = delete;
  RigStream& operator=(const RigStream&) = delete;

  /** In the order of receive times, as far as possible. Throws what TimeBatcher::push throws. */
  void take(const DatagramView&);

  /** Every datagram received before `now` was taken. */
  void advance(Timestamp now);

  /** Samples of the body's IMU, later than those of the rig; before the datagrams that were received after them. */
  void takeBodyImu(const std::vector<ImuSample>& samples) { imu_.addBody(samples); }

  /** How far the batcher's time has advanced: no datagram should have been received before it. */
  Timestamp time() const { return time_; }

  /** No more datagrams will come: all that waits is given out. */
  void finish();

  /** From here on the lidar sends to this address, in this decoder's format. */
  void replace(LidarIndex, std::shared_ptr<const PacketDecoder>, const LidarAddress&);

  /**
   * Lidars whose metadata may have changed, since the last call: those that have started again, or sent packets that
   * fit neither their decoder nor the packets before.
   */
  std::vector<LidarIndex> takeSuspects();

  /** The next event that is ready. */
  std::optional<SensorEvent> next();

  /** The notices of batcher and router since the last call, as lines of text. */
  std::vector<std::string> takeWarnings();

  /** Without `input`, which the stream does not know. */
  RigAccount account() const;

 private:
  const BatchedLidar& lidar(LidarIndex lidar) const { return batcher_.lidars()[lidar]; }
  void takeImu(const RoutedPacket&);
  std::vector<Scan> onward(const std::function<std::vector<Scan>()>& step);
  void judgeEarlyImu(LidarIndex, Timestamp received);
  void release(std::vector<Scan> scans);
  void releaseImu(Timestamp horizon);
  void releaseParts(Timestamp end);

  /** Of one lidar. */
  struct LidarImu
  {
    ImuContinuity continuity;
    std::uint64_t implausible = 0;  // samples
    bool reported = false;          // that there are such samples
    bool by_lidar = false;          // what came before the lidar's first packet is judged by its clock, too
  };

  PacketRouter router_;
  std::optional<CaptureClock> capture_clock_;
  TimeBatcher batcher_;
  Duration imu_patience_;  // how long a scan or sample waits for older IMU samples
  Timestamp time_ = Timestamp::min();
  ImuOrder imu_;
  std::vector<LidarImu> lidar_imus_;
  std::deque<ScanPart> parts_;  // from the batcher, until their scan is given out
  std::deque<SensorEvent> ready_;
  std::vector<std::uint64_t> strange_;  // packets per lidar that fit nothing, as of takeSuspects()
  std::vector<LidarIndex> restarted_;   // until takeSuspects()
};
}  // namespace scanloom
