/** Sends datagrams to this computer as lidars would, from addresses of their own (127.0.0.2, 127.0.0.3, ...). */
#pragma once
#include "input/packets/Datagram.h"

#include <netinet/in.h>
#include <sys/socket.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "input/packets/FileDescriptor.h"

namespace scanloom
{
class UdpSender
{
 public:
  /** To its destination port on 127.0.0.1, or ::1 for an IPv6 source, from its source address. */
  void send(const DatagramView& datagram)
  {
    const sockaddr_storage to = address(
        datagram.source.isV4() ? IpAddress::parse("127.0.0.1") : IpAddress::parse("::1"), datagram.destination_port);
    const ssize_t sent = ::sendto(socketOf(datagram.source), datagram.payload.data(), datagram.payload.size(), 0,
                                  reinterpret_cast<const sockaddr*>(&to),
                                  datagram.source.isV4() ? sizeof(sockaddr_in) : sizeof(sockaddr_in6));
    if (sent != static_cast<ssize_t>(datagram.payload.size())) throw std::runtime_error("UdpSender: not sent");
  }

  /** In the rhythm of their stamps, `speed` times as fast. */
  void replay(const std::vector<Datagram>& datagrams, double speed = 1)
  {
    if (datagrams.empty()) return;
    const auto start = std::chrono::steady_clock::now();
    for (const Datagram& datagram : datagrams)
    {
      const double since = seconds(datagram.received - datagrams.front().received) / speed;
      std::this_thread::sleep_until(start + fromSeconds(since));
      send(datagram);
    }
  }

 private:
  int socketOf(const IpAddress& source)
  {
    const auto known = sockets_.find(source);
    if (known != sockets_.end()) return known->second.number();
    FileDescriptor socket(::socket(source.isV4() ? AF_INET : AF_INET6, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    const sockaddr_storage from = address(source, 0);
    if (::bind(socket.number(), reinterpret_cast<const sockaddr*>(&from),
               source.isV4() ? sizeof(sockaddr_in) : sizeof(sockaddr_in6)) != 0)
      throw std::runtime_error("UdpSender: cannot send from " + source.text());
    return sockets_.emplace(source, std::move(socket)).first->second.number();
  }

  static sockaddr_storage address(const IpAddress& ip, std::uint16_t port)
  {
    sockaddr_storage storage{};
    if (ip.isV4())
    {
      auto& v4 = reinterpret_cast<sockaddr_in&>(storage);
      v4.sin_family = AF_INET;
      v4.sin_port = htons(port);
      std::memcpy(&v4.sin_addr, ip.wire().data(), 4);
    }
    else
    {
      auto& v6 = reinterpret_cast<sockaddr_in6&>(storage);
      v6.sin6_family = AF_INET6;
      v6.sin6_port = htons(port);
      std::memcpy(&v6.sin6_addr, ip.wire().data(), 16);
    }
    return storage;
  }

  std::map<IpAddress, FileDescriptor> sockets_;
};

/** Whether some program of this computer receives there. */
inline bool isReceivedOn(std::uint16_t port)
{
  char hexadecimal[8];
  std::snprintf(hexadecimal, sizeof hexadecimal, ":%04X ", port);
  for (const char* table : {"/proc/net/udp", "/proc/net/udp6"})
  {
    std::ifstream file(table);
    for (std::string line; std::getline(file, line);)
      if (line.find(hexadecimal) != std::string::npos) return true;
  }
  return false;
}

/** A port of this computer that nobody receives on at the moment. */
inline std::uint16_t freeUdpPort()
{
  const FileDescriptor socket(::socket(AF_INET6, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_in6 any{};
  any.sin6_family = AF_INET6;
  socklen_t size = sizeof any;
  if (::bind(socket.number(), reinterpret_cast<const sockaddr*>(&any), size) != 0 ||
      ::getsockname(socket.number(), reinterpret_cast<sockaddr*>(&any), &size) != 0)
    throw std::runtime_error("no free UDP port");
  return ntohs(any.sin6_port);
}
}  // namespace scanloom
