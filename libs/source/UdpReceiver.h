#pragma once
#include "source/DatagramRing.h"
#include "source/SteadyStamps.h"
#include "source/UdpSocket.h"

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
  std::vector<IpAddress> sources{};  // who may send there; empty: anybody
  std::size_t slots = 512;           // datagrams that wait at most for the reader
};

struct UdpReceiverOptions
{
  std::vector<UdpPort> ports;
  std::optional<IpAddress> bind_address;    // none: every address of this computer
  std::size_t receive_buffer = 16'000'000;  // bytes per port, asked of the kernel
  std::size_t slot_bytes = 65536;           // the longest datagram that is taken; any UDP datagram fits 65536
};

/** What became of the datagrams that reached a port. */
struct UdpCounters
{
  std::uint64_t datagrams = 0;     // given to the reader
  std::uint64_t filtered = 0;      // of a source that is not among the port's
  std::uint64_t truncated = 0;     // longer than a slot
  std::uint64_t dropped = 0;       // no empty slot: the reader was too slow
  std::uint64_t kernel_drops = 0;  // no room in the kernel's buffer: this thread was too slow
  std::uint64_t errors = 0;        // that the socket reported (network down, ...): reception goes on

  UdpCounters& operator+=(const UdpCounters&);
};

/**
 * Receives on several ports in one thread, which waits for nobody: what finds no empty slot is dropped and counted.
 * Stamps are the kernel's, on a clock that starts as CLOCK_REALTIME and does not step (SteadyStamps).
 */
class UdpReceiver
{
 public:
  /** Opens every port and begins; throws what UdpSocket throws, and std::invalid_argument for no port. */
  explicit UdpReceiver(const UdpReceiverOptions&);
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;
  ~UdpReceiver();

  std::size_t ports() const { return ports_.size(); }
  std::uint16_t port(std::size_t i) const { return ports_[i].socket.port(); }
  std::size_t grantedBuffer(std::size_t i) const { return ports_[i].socket.grantedBuffer(); }
  DatagramRing& ring(std::size_t i) { return ports_[i].ring; }

  /** For the one thread that reads the rings: waits until there may be something new, or `patience` has passed. */
  void wait(Duration patience);

  /** What is stamped earlier is in the rings already; ask before looking into them. */
  Timestamp drainedUntil() const { return drained_until_.load(std::memory_order_acquire); }

  /** For the reader: the port whose next datagram was received first, if that was before `drained`. */
  std::optional<std::size_t> oldestBefore(Timestamp drained);

  /** Takes what has reached the sockets, then ends. From any thread. */
  void stop() { stop_ = true; }

  /** Everything is in the rings, nothing more will come; ask before looking into them. */
  bool ended() const { return ended_.load(std::memory_order_acquire); }

  /** On the clock of the stamps. */
  Timestamp now() const { return stamps_.at(HostClocks::now()); }

  UdpCounters counters(std::size_t i) const;

  /** How often somebody set the host's clock. */
  std::uint64_t clockSteps() const { return clock_steps_; }

  /** Buffers smaller than asked for. */
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
    std::vector<DatagramRing::Slot*> hand;  // empty slots, ready to be filled
    Timestamp latest;                       // stamp of the newest datagram
    std::atomic<std::uint64_t> datagrams{0}, filtered{0}, truncated{0}, dropped{0}, overflowed{0}, errors{0};
  };

  /** Where the kernel writes a batch. */
  struct Batch
  {
    Batch();
    std::array<mmsghdr, kBatch> messages{};
    std::array<iovec, kBatch> payloads{};
    std::array<sockaddr_storage, kBatch> sources{};
    std::array<std::array<char, 128>, kBatch> control{};
  };

  void receive();
  bool drainAll();
  Timestamp drain(Port&);
  int receiveBatch(Port&, std::size_t size);
  void sort(Port&, std::size_t received, bool to_be_dropped);
  bool take(Port&, const mmsghdr&, DatagramRing::Slot&, Timestamp now);
  void notify();

  std::deque<Port> ports_;  // they cannot be moved
  SteadyStamps stamps_;
  Batch batch_;
  std::vector<std::uint8_t> scrap_;  // where datagrams go that are dropped
  DatagramRing::Slot scrap_slot_;
  FileDescriptor epoll_, event_;
  std::vector<epoll_event> ready_;
  std::atomic<Timestamp> drained_until_{Timestamp::min()};
  std::atomic<std::uint64_t> clock_steps_{0};
  std::atomic<bool> stop_{false}, ended_{false};
  std::thread thread_;  // last: it uses all of the above
};
}  // namespace scanloom
