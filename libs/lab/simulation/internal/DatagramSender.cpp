#include "lab/simulation/internal/DatagramSender.h"

#include "input/packets/SocketAddress.h"

#include <fmt/format.h>

#include <cstring>
#include <stdexcept>

namespace scanloom
{
namespace
{
FileDescriptor openSocket(const IpAddress& source)
{
  const SocketAddress own = SocketAddress::of(source, 0);
  FileDescriptor socket(::socket(own.storage.ss_family, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (socket.isOpen() && ::bind(socket.number(), own.get(), own.length) == 0) return socket;
  throw std::runtime_error(fmt::format("no UDP socket can be bound to {}: {}", source.text(), std::strerror(errno)));
}
}  // namespace

DatagramSender::DatagramSender(const IpAddress& source) : socket_(openSocket(source)) {}

bool DatagramSender::send(const Datagram& datagram, const IpAddress& destination) const
{
  const SocketAddress to = SocketAddress::of(destination, datagram.destination_port);
  const auto size = static_cast<ssize_t>(datagram.payload.size());
  return ::sendto(socket_.number(), datagram.payload.data(), datagram.payload.size(), 0, to.get(), to.length) == size;
}
}  // namespace scanloom
