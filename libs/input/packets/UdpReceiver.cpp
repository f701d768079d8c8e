#include "input/packets/UdpReceiver.h"

#include <poll.h>
#include <pthread.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace scanloom
{
namespace
{
// How long a silent network keeps this thread asleep: the reader's deadlines are no finer than this.
constexpr int kTickMs = 1;

// A socket that fills faster than it is emptied must not keep the others waiting.
constexpr int kBatchesInTurn = 16;

// At the end, sockets that never become empty are left alone.
constexpr Duration kLongestEnd = 1s;

struct Ancillary
{
  std::optional<Timestamp> stamp;            // of CLOCK_REALTIME
  std::optional<std::uint32_t> lost_so_far;  // by this socket
};

Ancillary ancillaryOf(const msghdr& message)
{
  Ancillary ancillary;
  auto* header = const_cast<msghdr*>(&message);  // what the macros want
  for (cmsghdr* c = CMSG_FIRSTHDR(header); c; c = CMSG_NXTHDR(header, c))
  {
    if (c->cmsg_level != SOL_SOCKET) continue;
    if (c->cmsg_type == SCM_TIMESTAMPNS)
    {
      timespec t{};
      std::memcpy(&t, CMSG_DATA(c), sizeof t);
      ancillary.stamp = Timestamp(std::chrono::seconds(t.tv_sec) + Duration(t.tv_nsec));
    }
    else if (c->cmsg_type == SO_RXQ_OVFL)
    {
      std::uint32_t count = 0;
      std::memcpy(&count, CMSG_DATA(c), sizeof count);
      ancillary.lost_so_far = count;
    }
  }
  return ancillary;
}
}  // namespace

UdpCounters& UdpCounters::operator+=(const UdpCounters& other)
{
  datagrams += other.datagrams;
  filtered += other.filtered;
  truncated += other.truncated;
  dropped += other.dropped;
  kernel_drops += other.kernel_drops;
  errors += other.errors;
  return *this;
}

UdpReceiver::Port::Port(const UdpReceiverOptions& options, const UdpPort& port)
  : socket({port.port, options.bind_address, options.receive_buffer}),
    sources(port.sources),
    ring(port.slots, options.slot_bytes)
{
}

bool UdpReceiver::Port::mayCome(const IpAddress& source) const
{
  return sources.empty() || std::find(sources.begin(), sources.end(), source) != sources.end();
}

UdpReceiver::Batch::Batch(std::size_t slot_bytes) : dropped_bytes(slot_bytes)
{
  dropped.bytes = dropped_bytes.data();
  for (std::size_t i = 0; i < kBatch; ++i)
  {
    messages[i].msg_hdr.msg_name = &sources[i].storage;
    messages[i].msg_hdr.msg_iov = &payloads[i];
    messages[i].msg_hdr.msg_iovlen = 1;
    messages[i].msg_hdr.msg_control = control[i].data();
  }
}

UdpReceiver::UdpReceiver(const UdpReceiverOptions& options)
  : stamps_(HostClocks::now()),
    batch_(options.slot_bytes),
    epoll_(::epoll_create1(EPOLL_CLOEXEC)),
    event_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC))
{
  if (options.ports.empty()) throw std::invalid_argument("UdpReceiver: no port given");
  for (const UdpPort& port : options.ports) ports_.emplace_back(options, port);
  ready_.resize(ports_.size());

  if (!epoll_.isOpen() || !event_.isOpen()) throw std::runtime_error("too many files are open: raise 'ulimit -n'");
  for (std::size_t i = 0; i < ports_.size(); ++i)
  {
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u64 = i;
    ::epoll_ctl(epoll_.number(), EPOLL_CTL_ADD, ports_[i].socket.descriptor(), &event);
  }
  thread_ = std::thread([this] { receive(); });
  ::pthread_setname_np(thread_.native_handle(), "scanloom-udp");
}

UdpReceiver::~UdpReceiver()
{
  stop();
  thread_.join();
}

void UdpReceiver::wait(Duration patience)
{
  pollfd descriptor{event_.number(), POLLIN, 0};
  const auto ms = std::chrono::ceil<std::chrono::milliseconds>(patience).count();
  ::poll(&descriptor, 1, static_cast<int>(std::clamp<std::int64_t>(ms, 0, 60'000)));
  std::uint64_t count = 0;
  if (::read(event_.number(), &count, sizeof count) < 0) return;  // nothing new
}

void UdpReceiver::notify()
{
  const std::uint64_t one = 1;
  if (::write(event_.number(), &one, sizeof one) < 0) return;  // 2^64 - 2 notifications wait already
}

void UdpReceiver::receive()
{
  while (!stop_)
  {
    epoll_event event{};
    ::epoll_wait(epoll_.number(), &event, 1, kTickMs);
    drainAll();
    notify();
  }
  const HostClocks stopped = HostClocks::now();
  while (!drainAll() && HostClocks::now().monotonic - stopped.monotonic < kLongestEnd) notify();
  ended_.store(true, std::memory_order_release);
  notify();
}

/** Receives what is in the sockets. Returns whether all are empty. */
bool UdpReceiver::drainAll()
{
  const HostClocks clocks = HostClocks::now();
  stamps_.observe(clocks);
  const Timestamp now = stamps_.at(clocks);
  Timestamp drained = now;

  // After the clock was read: everything that reached a socket before that time is seen here.
  const int n = ::epoll_wait(epoll_.number(), ready_.data(), static_cast<int>(ready_.size()), 0);
  for (int i = 0; i < n; ++i) drained = std::min(drained, drain(ports_[ready_[static_cast<std::size_t>(i)].data.u64]));

  clock_steps_ = stamps_.steps();
  if (drained > drained_until_.load(std::memory_order_relaxed))
    drained_until_.store(drained, std::memory_order_release);
  return drained == now;
}

/** Receives from a socket. Returns the stamp until which all of its datagrams are in the ring. */
Timestamp UdpReceiver::drain(Port& port)
{
  for (int batches = 0; batches < kBatchesInTurn; ++batches)
  {
    while (port.hand.size() < kBatch)
    {
      DatagramRing::Slot* slot = port.ring.takeEmpty();
      if (!slot) break;
      port.hand.push_back(slot);
    }
    const bool full = port.hand.empty();
    const std::size_t size = full ? kBatch : port.hand.size();
    const int received = receiveBatch(port, size);
    if (received < 0 && errno == EINTR) continue;
    if (received < 0 && errno == EAGAIN) return Timestamp::max();
    if (received < 0)
    {
      ++port.errors;  // reading has cleared it: socket(7), SO_ERROR
      return port.latest;
    }
    sort(port, static_cast<std::size_t>(received), full);
    if (static_cast<std::size_t>(received) < size) return Timestamp::max();
  }
  return port.latest;
}

int UdpReceiver::receiveBatch(Port& port, std::size_t size)
{
  for (std::size_t i = 0; i < size; ++i)
  {
    batch_.payloads[i] = {port.hand.empty() ? batch_.dropped.bytes : port.hand[i]->bytes, port.ring.slotBytes()};
    batch_.messages[i].msg_hdr.msg_namelen = sizeof(sockaddr_storage);
    batch_.messages[i].msg_hdr.msg_controllen = batch_.control[i].size();
    batch_.messages[i].msg_hdr.msg_flags = 0;
  }
  return ::recvmmsg(port.socket.descriptor(), batch_.messages.data(), static_cast<unsigned>(size), MSG_DONTWAIT,
                    nullptr);
}

/** Passes slots with accepted datagrams to the reader; the others stay in `hand`. */
void UdpReceiver::sort(Port& port, std::size_t received, bool to_be_dropped)
{
  const HostClocks clocks = HostClocks::now();
  stamps_.observe(clocks);
  const Timestamp now = stamps_.at(clocks);

  std::size_t kept = 0;
  for (std::size_t i = 0; i < received; ++i)
  {
    DatagramRing::Slot* slot = to_be_dropped ? &batch_.dropped : port.hand[i];
    const bool good = take(port, i, *slot, now);
    if (to_be_dropped)
      port.dropped += good;
    else if (good)
    {
      ++port.datagrams;
      port.ring.push(slot);
    }
    else
      port.hand[kept++] = slot;
  }
  if (!to_be_dropped) port.hand.erase(port.hand.begin() + kept, port.hand.begin() + received);
}

/** Fills the slot's header. Returns whether the datagram is accepted, and counts why not. */
bool UdpReceiver::take(Port& port, std::size_t of_batch, DatagramRing::Slot& slot, Timestamp now)
{
  const mmsghdr& message = batch_.messages[of_batch];
  const Ancillary ancillary = ancillaryOf(message.msg_hdr);
  if (ancillary.lost_so_far) port.overflowed = *ancillary.lost_so_far;
  slot.received = ancillary.stamp ? stamps_.steady(*ancillary.stamp, port.latest, now) : now;
  port.latest = std::max(port.latest, slot.received);

  slot.source = batch_.sources[of_batch].ip();
  slot.source_port = batch_.sources[of_batch].port();
  slot.size = message.msg_len;
  const bool truncated = (message.msg_hdr.msg_flags & MSG_TRUNC) != 0;
  const bool filtered = !port.mayCome(slot.source);
  port.filtered += filtered;
  port.truncated += truncated && !filtered;
  return !truncated && !filtered;
}

std::optional<std::size_t> UdpReceiver::oldestBefore(Timestamp drained)
{
  std::optional<std::size_t> oldest;
  Timestamp received = drained;
  for (std::size_t i = 0; i < ports_.size(); ++i)
  {
    const DatagramRing::Slot* front = ports_[i].ring.front();
    if (!front || front->received >= received) continue;
    oldest = i;
    received = front->received;
  }
  return oldest;
}

UdpCounters UdpReceiver::counters(std::size_t i) const
{
  const Port& port = ports_[i];
  UdpCounters counters;
  counters.datagrams = port.datagrams;
  counters.filtered = port.filtered;
  counters.truncated = port.truncated;
  counters.dropped = port.dropped;
  // Datagrams tell only about drops before them; the socket knows those after the newest, too.
  counters.kernel_drops = std::max<std::uint64_t>(port.overflowed, port.socket.kernelDrops());
  counters.errors = port.errors;
  return counters;
}

std::vector<std::string> UdpReceiver::warnings() const
{
  std::vector<std::string> warnings;
  for (const Port& port : ports_)
    if (std::string warning = port.socket.bufferWarning(); !warning.empty()) warnings.push_back(std::move(warning));
  return warnings;
}
}  // namespace scanloom
