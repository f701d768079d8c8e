/** What browsers, and others, ask of a server of pages: plain sockets of the loopback interface. */
#pragma once
#include "input/packets/FileDescriptor.h"
#include "input/packets/SensorAddress.h"
#include "input/packets/SocketAddress.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <chrono>
#include <filesystem>
#include <string>

namespace scanloom
{
inline const SensorAddress kAnyPort{SensorAddress::parse("127.0.0.1").ip, 0};

inline bool pageIsThere() { return std::filesystem::exists("/usr/share/javascript/three/three.min.js"); }

class Browser
{
 public:
  Browser(const std::string& address, const std::string& request) : socket_(::socket(AF_INET, SOCK_STREAM, 0))
  {
    const SensorAddress asked = SensorAddress::parse(address);
    const SocketAddress where = SocketAddress::of(asked.ip, asked.port);
    EXPECT_EQ(::connect(socket_.number(), where.get(), where.length), 0);
    ::send(socket_.number(), request.data(), request.size(), MSG_NOSIGNAL);
  }

  /** All that comes within the time, or until there is `enough`. */
  std::string read(std::chrono::milliseconds time, const std::string& enough = "\xff never") const
  {
    std::string text;
    const std::chrono::steady_clock::time_point end = std::chrono::steady_clock::now() + time;
    while (std::chrono::steady_clock::now() < end && text.find(enough) == std::string::npos)
    {
      pollfd readable{socket_.number(), POLLIN, 0};
      if (::poll(&readable, 1, 20) <= 0) continue;
      char part[4096];
      const ssize_t received = ::recv(socket_.number(), part, sizeof part, 0);
      if (received <= 0) break;
      text.append(part, static_cast<std::size_t>(received));
    }
    return text;
  }

 private:
  FileDescriptor socket_;
};

/** `address`: "127.0.0.1:8080". */
inline std::string wholeAnswer(const std::string& address, const std::string& request)
{
  return Browser(address, request).read(std::chrono::seconds(20));
}
}  // namespace scanloom
