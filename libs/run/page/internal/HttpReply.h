#pragma once
#include <atomic>
#include <chrono>
#include <string_view>

namespace scanloom
{
/**
 * The answer to one request, on a socket that does not block. What is not taken within its time is given up, and the
 * connection with it: nothing is kept for a reader that is slower than that.
 */
class HttpReply
{
 public:
  static constexpr std::chrono::seconds kLongest{10};  // for all of a plain answer, or for one part of a stream

  /** `stopping` ends every wait. */
  HttpReply(int socket, const std::atomic<bool>& stopping) : socket_(socket), stopping_(stopping) {}

  /** A whole answer. */
  void send(int status, std::string_view type, std::string_view body);

  /** The head of an answer whose parts follow by write(). */
  bool beginStream(std::string_view type);

  /** False once the reader is gone, was too slow, or the server stops. */
  bool write(std::string_view bytes);

  /** Whether the other side is still there. */
  bool isOpen() const;

  /** Sleeps; false once there is no more to be said to anybody. */
  bool pause(std::chrono::steady_clock::duration) const;

 private:
  bool writeUntil(std::string_view bytes, std::chrono::steady_clock::time_point deadline);

  int socket_;
  const std::atomic<bool>& stopping_;
  bool open_ = true;
};
}  // namespace scanloom
