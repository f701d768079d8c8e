/**
 * Readers of a page in a process of their own. Of four, one takes all, one stalls, one reads a byte a second, and one
 * floods: 2000 requests a second for the page's largest file, none of whose answers it reads.
 */
#pragma once
#include "input/packets/SocketAddress.h"
#include "run/page/LiveServer.h"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <vector>

namespace scanloom::bench
{
class PageReaders
{
 public:
  PageReaders(int count, const SensorAddress& page)
  {
    if (count == 0) return;
    if (::pipe(counted_) != 0) return;
    process_ = ::fork();
    if (process_ == 0) read(count, page);
  }
  PageReaders(const PageReaders&) = delete;
  PageReaders& operator=(const PageReaders&) = delete;
  ~PageReaders() { stop(); }

  /** Bits per second that the first reader, which takes all, has got. */
  double stop()
  {
    if (process_ <= 0) return 0;
    ::kill(process_, SIGTERM);
    double bits_per_second = 0;
    if (::read(counted_[0], &bits_per_second, sizeof bits_per_second) != sizeof bits_per_second) bits_per_second = 0;
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
    return bits_per_second;
  }

 private:
  static constexpr int kTakesAll = 0, kStalls = 1, kReadsAByteASecond = 2, kFloods = 3;

  static int connect(const SensorAddress& page)
  {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    const SocketAddress where = SocketAddress::of(page.ip, page.port);
    const std::string request = fmt::format("GET /points HTTP/1.1\r\nHost: {}\r\n\r\n", page.text());
    if (::connect(socket, where.get(), where.length) != 0) return -1;
    return ::send(socket, request.data(), request.size(), MSG_NOSIGNAL) > 0 ? socket : -1;
  }

  /** Ends the connections of the last time, and opens as many. */
  static void flood(const SensorAddress& page, std::vector<int>& sockets)
  {
    constexpr int kAtOnce = 10;  // every 5 ms
    for (const int socket : sockets) ::close(socket);
    sockets.clear();
    const SocketAddress where = SocketAddress::of(page.ip, page.port);
    const std::string request = fmt::format("GET /three.min.js HTTP/1.1\r\nHost: {}\r\n\r\n", page.text());
    for (int i = 0; i < kAtOnce; ++i)
    {
      sockets.push_back(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0));
      ::connect(sockets.back(), where.get(), where.length);
      ::send(sockets.back(), request.data(), request.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    }
  }

  [[noreturn]] void read(int count, const SensorAddress& page) const
  {
    using Clock = std::chrono::steady_clock;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    sigset_t end;
    sigemptyset(&end);
    sigaddset(&end, SIGTERM);
    sigprocmask(SIG_BLOCK, &end, nullptr);
    std::vector<int> sockets, flood_sockets;
    for (int i = 0; i < count; ++i) sockets.push_back(i % 4 == kFloods ? -1 : connect(page));
    const Clock::time_point start = Clock::now();
    Clock::time_point next_byte = start;
    std::uint64_t bytes = 0;
    std::vector<char> part(1 << 16);
    const timespec pause{0, 5000000};
    while (::sigtimedwait(&end, nullptr, &pause) < 0)
    {
      const bool byte_is_due = Clock::now() >= next_byte;
      if (byte_is_due) next_byte += std::chrono::seconds(1);
      for (int i = 0; i < count; ++i)
      {
        const bool byte_by_byte = i % 4 == kReadsAByteASecond;
        if (i % 4 == kFloods) flood(page, flood_sockets);
        if (i % 4 == kFloods || i % 4 == kStalls || (byte_by_byte && !byte_is_due)) continue;
        const ssize_t got = ::recv(sockets[i], part.data(), byte_by_byte ? 1 : part.size(), MSG_DONTWAIT);
        if (i == kTakesAll && got > 0) bytes += static_cast<std::uint64_t>(got);
      }
    }
    const double rate = 8.0 * static_cast<double>(bytes) / std::chrono::duration<double>(Clock::now() - start).count();
    const bool told = ::write(counted_[1], &rate, sizeof rate) == sizeof rate;
    ::_exit(told ? 0 : 1);
  }

  int counted_[2] = {-1, -1};
  pid_t process_ = -1;
};
}  // namespace scanloom::bench
