/** A sensor that answers with more than an answer; healthy and other faulty ones: tests/simulation/OusterHttp. */
#include "input/packets/SensorHttp.h"

#include <gtest/gtest.h>
#include <httplib.h>

#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <stdexcept>
#include <string>
#include <thread>

#include "input/packets/FileDescriptor.h"

namespace scanloom::sensor_http_unittest
{
namespace
{
/** Takes one connection and sends `head` and then `again` until the other side has enough. */
class EndlessServer
{
 public:
  EndlessServer(std::string head, std::string again)
    : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)), head_(std::move(head)), again_(std::move(again))
  {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* any = reinterpret_cast<sockaddr*>(&address);
    if (::bind(listener_.number(), any, size) != 0 || ::listen(listener_.number(), 1) != 0 ||
        ::getsockname(listener_.number(), any, &size) != 0)
      throw std::runtime_error("EndlessServer: no port");
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~EndlessServer()
  {
    ::shutdown(listener_.number(), SHUT_RDWR);
    thread_.join();
  }
  EndlessServer(const EndlessServer&) = delete;
  EndlessServer& operator=(const EndlessServer&) = delete;

  SensorAddress address() const { return SensorAddress::parse("127.0.0.1:" + std::to_string(port_)); }

 private:
  void serve()
  {
    const FileDescriptor connection(::accept(listener_.number(), nullptr, nullptr));
    const timeval patience{1, 0};  // with a client that reads no more and does not close either
    ::setsockopt(connection.number(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    std::string text = head_;
    while (::send(connection.number(), text.data(), text.size(), MSG_NOSIGNAL) > 0) text = again_;
  }

  FileDescriptor listener_;
  std::string head_, again_;
  std::uint16_t port_ = 0;
  std::thread thread_;
};

double mostMegabytes()
{
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

SensorFault faultOf(const SensorAddress& address)
{
  try
  {
    SensorHttp(address, {2s, 1024 * 1024}).get("/");
  }
  catch (const SensorHttpError& error)
  {
    return error.fault;
  }
  throw std::logic_error("an endless answer ended");
}
}  // namespace

TEST(SensorHttp, headersWithoutEndAreAnAnswerThatIsTooLarge)
{
  std::string headers;
  for (int i = 0; i < 1000; ++i) headers += "X-" + std::to_string(i) + ": " + std::string(80, 'x') + "\r\n";
  const EndlessServer server("HTTP/1.1 200 OK\r\n", headers);
  const double before = mostMegabytes();
#ifdef CPPHTTPLIB_HEADER_MAX_COUNT  // since 0.18.7 or before, cpp-httplib ends it itself
  EXPECT_EQ(faultOf(server.address()), SensorFault::Interrupted);
#else
  EXPECT_EQ(faultOf(server.address()), SensorFault::TooLarge);
#endif
  EXPECT_LT(mostMegabytes() - before, 60) << "they come with hundreds of megabytes a second";
}
}  // namespace scanloom::sensor_http_unittest
