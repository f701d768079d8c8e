#pragma once
#include "source/EventQueue.h"
#include "source/LiveCapture.h"
#include "source/LiveSensors.h"
#include "source/RigStream.h"
#include "source/UdpReceiver.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>

namespace scanloom
{
/** The ports of a rig's lidars, and who may send there. */
UdpReceiverOptions receiverOptions(const Rig&);

/**
 * A rig's sockets through the batcher. One thread receives (UdpReceiver), one merges in the order of the kernel's
 * stamps and batches; whoever calls next() takes scans from a bounded queue and keeps neither of them waiting.
 * Datagrams go into the capture in the order and with the stamps that the batcher sees: its replay gives the same scans
 * to the bit.
 */
class RigLive : public RigInput
{
 public:
  /**
   * Opens the rig's ports and begins. Throws what UdpSocket and LiveCapture throw, and std::invalid_argument for a rig
   * with a recorded IMU, whose stamps are of the past.
   */
  explicit RigLive(const Rig&);
  ~RigLive() override;

  using RigInput::next;

  /** Also throws what ended the batching: see RigStream::take. */
  std::optional<SensorEvent> next(Duration patience) override;
  bool ended() const override { return queue_.ended(); }
  void stop() override { receiver_.stop(); }
  double progress() const override { return 0; }

  /** A tenth of a second old at most. */
  RigAccount account() const override;

  std::vector<std::string> takeWarnings() override;
  void refresh(Rig&) const override;

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
  EventQueue queue_;
  std::unique_ptr<LiveCapture> capture_;  // none if it is not wanted
  UdpReceiver receiver_;
  Timestamp newest_;             // datagram that was taken
  Duration release_latency_{0};  // the consumer's own
  std::uint64_t restamped_ = 0;
  bool capture_failure_told_ = false;

  LiveSensors sensors_;

  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<const PacketDecoder>> decoders_;  // in use
  RigAccount account_;                                          // as of the latest publication
  std::vector<std::string> warnings_;                           // until they are taken, or too many
  std::thread thread_;                                          // last: it uses all of the above
};
}  // namespace scanloom
