#pragma once
#include "base/core/BoundedQueue.h"
#include "input/packets/UdpReceiver.h"
#include "input/rig/internal/LiveCapture.h"
#include "input/rig/internal/LiveSensors.h"
#include "input/rig/internal/RigStream.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>

namespace scanloom
{
/** An event on its way from the thread that batches to the one that calls next(). */
struct ReceivedEvent
{
  SensorEvent event;
  Timestamp newest;  // when the newest datagram was received that it was made of
};

/**
 * A rig's sockets through the batcher. One thread receives (UdpReceiver), one merges the datagrams in the order of the
 * kernel's stamps and batches them; the caller of next() takes scans from a bounded queue, and neither thread waits for
 * it. The capture has the datagrams in the order and with the stamps that the batcher gets: its replay gives the same
 * scans to the bit. More than a dozen members: the merging thread's own, and what it shares under the mutex.
 */
class RigLive : public SensorInput
{
 public:
  /**
   * Opens the rig's ports and starts receiving. Throws what UdpSocket and LiveCapture throw, and std::invalid_argument
   * for a rig with a recorded IMU.
   */
  explicit RigLive(const Rig&);
  ~RigLive() override;

  using SensorInput::next;

  /** Also throws what ended the batching: see RigStream::take. */
  std::optional<SensorEvent> next(Duration patience) override;
  bool ended() const override { return queue_.ended(); }
  void stop() override { receiver_.stop(); }

  /** With the lidars whose sensors have answered by now. */
  SensorSetup setup() const override;

  /** A tenth of a second old at most. */
  RigAccount account() const override;

  std::vector<std::string> takeWarnings() override;

  /**
   * Of the scan that next() gave last: from the kernel's stamp of the datagram that completed it (or, if a deadline
   * did, of the newest one) to its being taken from the queue.
   */
  Duration releaseLatency() const { return release_latency_; }

  const UdpReceiver& receiver() const { return receiver_; }

 private:
  void merge();
  void takeUntil(Timestamp drained);
  void takeFrom(std::size_t port);
  void giveOut();
  void publish();
  bool receivesAt(std::uint16_t port) const;
  void followSensors(std::vector<std::string>& warnings);

  RigStream stream_;
  BoundedQueue<ReceivedEvent> queue_;
  std::unique_ptr<LiveCapture> capture_;  // none if it is not wanted
  UdpReceiver receiver_;
  Timestamp newest_;             // datagram that was taken
  Duration release_latency_{0};  // the consumer's own
  std::uint64_t restamped_ = 0;

  LiveSensors sensors_;

  mutable std::mutex mutex_;
  Rig rig_;                            // with the decoders in use
  RigAccount account_;                 // as of the latest publication
  std::vector<std::string> warnings_;  // until they are taken, or too many
  std::thread thread_;                 // last: it uses all of the above
};
}  // namespace scanloom
