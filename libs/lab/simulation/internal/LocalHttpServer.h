#pragma once
#include <functional>
#include <memory>
#include <string>
#include <thread>

namespace httplib
{
class Server;
struct Request;
struct Response;
}  // namespace httplib

namespace scanloom
{
/** An HTTP server on this computer, in threads of its own. */
class LocalHttpServer
{
 public:
  using Answer = std::function<void(const httplib::Request&, httplib::Response&)>;

  /**
   * Calls `answer` for every GET and POST, from several threads at a time. `port` 0: any free one. Throws
   * std::runtime_error if the port is taken.
   */
  LocalHttpServer(const std::string& host, int port, const Answer& answer);

  /** Returns when no `answer` is running any more. */
  ~LocalHttpServer();

  LocalHttpServer(const LocalHttpServer&) = delete;
  LocalHttpServer& operator=(const LocalHttpServer&) = delete;

  /** "127.0.0.2:41233" */
  std::string address() const;

 private:
  std::string host_;
  int port_ = 0;
  std::unique_ptr<httplib::Server> server_;
  std::thread thread_;
};
}  // namespace scanloom
