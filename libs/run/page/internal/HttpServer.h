#pragma once
#include "input/packets/FileDescriptor.h"
#include "input/packets/SensorAddress.h"
#include "run/page/internal/HttpReply.h"
#include "run/page/internal/HttpRequest.h"

#include <atomic>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <thread>

namespace scanloom
{
/**
 * Answers the requests of a few browsers, one request per connection, each in a thread of its own that yields to
 * everything else on the computer. Not cpp-httplib, as for sensors: there a request may have headers without end, and
 * take any time, and both would be our memory and our threads.
 */
class HttpServer
{
 public:
  /** Called in the connections' threads for requests that are sound and not foreign (refuseForeign()). */
  using Answer = std::function<void(const HttpRequest&, HttpReply&)>;

  static constexpr std::size_t kMostConnections = 32;    // further ones are refused
  static constexpr std::chrono::seconds kLongestAsk{5};  // for a whole request

  /** Port 0: any free one. Throws std::runtime_error if the address is taken or not this computer's. */
  HttpServer(const SensorAddress&, Answer);

  /** Ends all answers. */
  ~HttpServer();

  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /** With the port in use. */
  const SensorAddress& address() const { return address_; }

  /** "http://127.0.0.1:8080" */
  std::string url() const;

 private:
  struct Connection
  {
    FileDescriptor socket;
    std::atomic<bool> done{false};
    std::thread thread;
  };

  void accept();
  void forgetEnded();
  void serve(int socket);

  SensorAddress address_;
  Answer answer_;
  FileDescriptor listener_;
  std::atomic<bool> stopping_{false};
  std::list<std::unique_ptr<Connection>> connections_;  // of the accepting thread
  std::thread thread_;
};
}  // namespace scanloom
