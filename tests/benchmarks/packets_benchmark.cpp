/** What it costs to get a datagram of 24.8 kB (a packet of an OS-128) out of a socket, with the kernel's stamp. */
#include "input/packets/UdpReceiver.h"
#include "support/UdpSender.h"

#include <benchmark/benchmark.h>
#include <sys/select.h>

#include <array>
#include <chrono>

namespace
{
using namespace scanloom;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kBytes = 24832;

/** A socket in which a burst waits. */
class WaitingBurst
{
 public:
  WaitingBurst() : socket_({0, IpAddress::parse("127.0.0.1"), 100'000'000})
  {
    datagram_.source = IpAddress::parse("127.0.0.1");
    datagram_.destination_port = socket_.port();
    datagram_.payload.assign(kBytes, 7);
  }
  void send(std::int64_t count)
  {
    for (std::int64_t i = 0; i < count; ++i) sender_.send(datagram_);
  }
  int descriptor() const { return socket_.descriptor(); }

 private:
  UdpSocket socket_;
  UdpSender sender_;
  Datagram datagram_;
};

/** Messages that receive into slots of their own, with room for the sender and the stamp. */
template <std::size_t Batch>
struct Messages
{
  Messages() : bytes(Batch * 65536)
  {
    for (std::size_t i = 0; i < Batch; ++i)
    {
      parts[i] = {bytes.data() + i * 65536, 65536};
      headers[i].msg_hdr.msg_iov = &parts[i];
      headers[i].msg_hdr.msg_iovlen = 1;
    }
    reset();
  }
  void reset()
  {
    for (std::size_t i = 0; i < Batch; ++i)
    {
      headers[i].msg_hdr.msg_name = &sources[i];
      headers[i].msg_hdr.msg_namelen = sizeof(sockaddr_storage);
      headers[i].msg_hdr.msg_control = control[i].data();
      headers[i].msg_hdr.msg_controllen = control[i].size();
    }
  }
  std::vector<std::uint8_t> bytes;
  std::array<mmsghdr, Batch> headers{};
  std::array<iovec, Batch> parts{};
  std::array<sockaddr_storage, Batch> sources{};
  std::array<std::array<char, 128>, Batch> control{};
};

template <typename Drain>
void measure(benchmark::State& state, Drain&& drain)
{
  WaitingBurst burst;
  std::int64_t received = 0;
  double elapsed = 0;
  for (auto _ : state)
  {
    burst.send(state.range(0));
    const Clock::time_point start = Clock::now();
    std::int64_t got = 0;
    while (got < state.range(0))
    {
      const int n = drain(burst.descriptor());
      if (n <= 0) return state.SkipWithError("datagrams were lost: the receive buffer is too small");
      got += n;
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    state.SetIterationTime(seconds);
    elapsed += seconds;
    received += got;
  }
  state.counters["us_per_datagram"] = 1e6 * elapsed / static_cast<double>(received);
}

void recvmmsgOf32(benchmark::State& state)
{
  Messages<32> messages;
  measure(state,
          [&](int socket)
          {
            messages.reset();
            return recvmmsg(socket, messages.headers.data(), 32, MSG_DONTWAIT, nullptr);
          });
}
BENCHMARK(recvmmsgOf32)->Name("drain/recvmmsg(32)")->UseManualTime()->Arg(32)->Arg(512);  // datagrams that wait: in the
                                                                                          // cache, and not

void selectAndRecvmsg(benchmark::State& state)
{
  Messages<1> messages;
  measure(state,
          [&](int socket)
          {
            fd_set ready;
            FD_ZERO(&ready);
            FD_SET(socket, &ready);
            timeval patience{1, 0};
            if (select(socket + 1, &ready, nullptr, nullptr, &patience) != 1) return 0;
            messages.reset();
            return recvmsg(socket, &messages.headers[0].msg_hdr, MSG_DONTWAIT) > 0 ? 1 : 0;
          });
}
BENCHMARK(selectAndRecvmsg)->Name("drain/select+recvmsg")->UseManualTime()->Arg(32)->Arg(512);  // datagrams that wait:
                                                                                                // in the cache, and not

void selectAndRecvfrom(benchmark::State& state)
{
  std::vector<std::uint8_t> bytes(65536);
  measure(state,
          [&](int socket)
          {
            fd_set ready;
            FD_ZERO(&ready);
            FD_SET(socket, &ready);
            timeval patience{1, 0};
            if (select(socket + 1, &ready, nullptr, nullptr, &patience) != 1) return 0;
            sockaddr_storage source{};
            socklen_t length = sizeof source;
            return recvfrom(socket, bytes.data(), bytes.size(), MSG_DONTWAIT, reinterpret_cast<sockaddr*>(&source),
                            &length) > 0
                       ? 1
                       : 0;
          });
}
BENCHMARK(selectAndRecvfrom)
    ->Name("drain/select+recvfrom")
    ->UseManualTime()
    ->Arg(32)
    ->Arg(512);  // datagrams that wait: in the cache, and not
}  // namespace
