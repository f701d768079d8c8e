#pragma once
#include "input/packets/SocketAddress.h"
#include "input/packets/internal/DatagramRing.h"
#include "input/packets/internal/SteadyStamps.h"
#include "input/packets/internal/UdpSocket.h"

#include <sys/epoll.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <deque>
#include <string>
#include <thread>
#include <vector>

namespace scanloom
{
struct UdpPort
{
  std::uint16_t port = 0;
  std::vector<IpAddress> sources{};  // accepted senders; empty: all
  std::size_t slots = 512;           // most datagrams that wait for the reader
};

struct UdpReceiverOptions
{
  std::vector<UdpPort> ports;
  std::optional<IpAddress> bind_address;    // none: all addresses of this computer
  std::size_t receive_buffer = 16'000'000;  // bytes per port, requested from the kernel
  std::size_t slot_bytes = 65536;           // longest datagram that is accepted; 65536 is enough for all
};

/** Counts of the datagrams of a port. */
struct UdpCounters
{
  std::uint64_t datagrams = 0;     // given to the reader
  std::uint64_t filtered = 0;      // from a sender that is not accepted
  std::uint64_t truncated = 0;     // longer than a slot
  std::uint64_t dropped = 0;       // no empty slot: the reader was too slow
  std::uint64_t kernel_drops = 0;  // no room in the kernel's buffer: this thread was too slow
  std::uint64_t errors = 0;        // reported by the socket (network down, ...); reception continues

  UdpCounters& operator+=(const UdpCounters&);
};

/**
 * Receives on several ports in a thread of its own. It never waits for the reader: datagrams without an empty slot are
 * dropped and counted. Stamps are the kernel's, on a clock that starts as CLOCK_REALTIME and never steps
 * (SteadyStamps).
 */
class UdpReceiver
{
 public:
  /** Opens all ports and starts. Throws as UdpSocket does, and std::invalid_argument if there is no port. */
  explicit UdpReceiver(const UdpReceiverOptions&);
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;
  ~UdpReceiver();

  std::size_t ports() const { return ports_.size(); }
  std::uint16_t port(std::size_t i) const { return ports_[i].socket.port(); }
  DatagramRing& ring(std::size_t i) { return ports_[i].ring; }

  /** For the reader: waits until there may be something new in the rings, at most for `patience`. */
  void wait(Duration patience);

  /** All datagrams with earlier stamps are in the rings. Call it before reading the rings. */
  Timestamp drainedUntil() const { return drained_until_.load(std::memory_order_acquire); }

  /** For the reader: the port with the oldest datagram in its ring, if that was received before `drained`. */
  std::optional<std::size_t> oldestBefore(Timestamp drained);

  /** Ends the reception after what has reached the sockets. From any thread. */
  void stop() { stop_ = true; }

  /** Whether the reception has ended and everything is in the rings. Call it before reading the rings. */
  bool ended() const { return ended_.load(std::memory_order_acquire); }

  /** The time of the stamps' clock. */
  Timestamp now() const { return stamps_.at(HostClocks::now()); }

  UdpCounters counters(std::size_t i) const;

  /** How often the host's clock was set. */
  std::uint64_t clockSteps() const { return clock_steps_; }

  /** A text for each port whose kernel buffer is smaller than requested. */
  std::vector<std::string> warnings() const;

 private:
  static constexpr std::size_t kBatch = 32;

  struct Port
  {
    Port(const UdpReceiverOptions&, const UdpPort&);
    bool mayCome(const IpAddress&) const;

    UdpSocket socket;
    std::vector<IpAddress> sources;
    DatagramRing ring;
    std::vector<DatagramRing::Slot*> hand;  // empty slots for the next batch
    Timestamp latest;                       // stamp of the newest datagram
    std::atomic<std::uint64_t> datagrams{0}, filtered{0}, truncated{0}, dropped{0}, overflowed{0}, errors{0};
  };

  /** Where the kernel writes a batch, and where datagrams go that are dropped. */
  struct Batch
  {
    explicit Batch(std::size_t slot_bytes);
    std::array<mmsghdr, kBatch> messages{};
    std::array<iovec, kBatch> payloads{};
    std::array<SocketAddress, kBatch> sources{};
    std::array<std::array<char, 128>, kBatch> control{};
    std::vector<std::uint8_t> dropped_bytes;
    DatagramRing::Slot dropped;
  };

  void receive();
  bool drainAll();
  Timestamp drain(Port&);
  int receiveBatch(Port&, std::size_t size);
  void sort(Port&, std::size_t received, bool to_be_dropped);
  bool take(Port&, std::size_t of_batch, DatagramRing::Slot&, Timestamp now);
  void notify();

  std::deque<Port> ports_;  // a deque, because they cannot be moved
  SteadyStamps stamps_;
  Batch batch_;
  FileDescriptor epoll_, event_;
  std::vector<epoll_event> ready_;
  std::atomic<Timestamp> drained_until_{Timestamp::min()};
  std::atomic<std::uint64_t> clock_steps_{0};
  std::atomic<bool> stop_{false}, ended_{false};
  std::thread thread_;  // last: it uses all of the above
};
}  // namespace scanloom
