/** Readers of a page in a process of their own: every fourth stalls, every fourth reads a byte a second. */
#pragma once
#include "live_view/LiveServer.h"
#include "packets/SocketAddress.h"

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
  static int connect(const SensorAddress& page)
  {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    const SocketAddress where = SocketAddress::of(page.ip, page.port);
    const std::string request = fmt::format("GET /points HTTP/1.1\r\nHost: {}\r\n\r\n", page.text());
    if (::connect(socket, where.get(), where.length) != 0) return -1;
    return ::send(socket, request.data(), request.size(), MSG_NOSIGNAL) > 0 ? socket : -1;
  }

  [[noreturn]] void read(int count, const SensorAddress& page) const
  {
    using Clock = std::chrono::steady_clock;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    sigset_t end;
    sigemptyset(&end);
    sigaddset(&end, SIGTERM);
    sigprocmask(SIG_BLOCK, &end, nullptr);
    std::vector<int> sockets;
    for (int i = 0; i < count; ++i) sockets.push_back(connect(page));
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
        const bool stalls = i % 4 == 1, byte_by_byte = i % 4 == 2;
        if (stalls || (byte_by_byte && !byte_is_due)) continue;
        const ssize_t got = ::recv(sockets[i], part.data(), byte_by_byte ? 1 : part.size(), MSG_DONTWAIT);
        if (i == 0 && got > 0) bytes += static_cast<std::uint64_t>(got);
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
