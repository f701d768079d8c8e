#include "run/page/internal/HttpReply.h"

#include "run/page/internal/HttpRequest.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <thread>

namespace scanloom
{
namespace
{
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

/** Nothing of another computer is loaded or run, no other page shows this one, and no proxy keeps it. */
std::string head(int status, std::string_view type)
{
  return fmt::format(
      "HTTP/1.1 {} {}\r\nContent-Type: {}\r\nConnection: close\r\nCache-Control: no-store\r\n"
      "X-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\n"
      "Content-Security-Policy: default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; "
      "frame-ancestors 'none'\r\n",
      status, status == kHttpOk ? "OK" : "Refused", type);
}
}  // namespace

void HttpReply::send(int status, std::string_view type, std::string_view body)
{
  const Clock::time_point deadline = Clock::now() + kLongest;
  const std::string first = head(status, type) + fmt::format("Content-Length: {}\r\n\r\n", body.size());
  if (writeUntil(first, deadline)) writeUntil(body, deadline);
}

bool HttpReply::beginStream(std::string_view type) { return write(head(kHttpOk, type) + "\r\n"); }

bool HttpReply::write(std::string_view bytes) { return writeUntil(bytes, Clock::now() + kLongest); }

bool HttpReply::writeUntil(std::string_view bytes, Clock::time_point deadline)
{
  while (open_ && !bytes.empty())
  {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0)
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    else if (sent < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)
      open_ = false;
    else
    {
      pollfd writable{socket_, POLLOUT, 0};
      ::poll(&writable, 1, 50);
    }
    if (stopping_ || Clock::now() > deadline) open_ = open_ && bytes.empty();
  }
  return open_;
}

bool HttpReply::isOpen() const
{
  char ignored = 0;
  const ssize_t received = ::recv(socket_, &ignored, 1, MSG_PEEK | MSG_DONTWAIT);
  const bool quiet = received < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
  return open_ && !stopping_ && (received > 0 || quiet);
}

bool HttpReply::pause(Clock::duration time) const
{
  const Clock::time_point end = Clock::now() + time;
  for (Clock::time_point now = Clock::now(); now < end && isOpen(); now = Clock::now())
    std::this_thread::sleep_for(std::min<Clock::duration>(20ms, end - now));
  return isOpen();
}
}  // namespace scanloom
