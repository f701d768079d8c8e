#include "input/packets/internal/bytesReceived.h"

// Not <netinet/tcp.h>: its tcp_info lacks the count, and both cannot be included.
#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace scanloom
{
std::uint64_t bytesReceived(int socket)
{
  tcp_info info{};
  socklen_t size = sizeof info;
  return ::getsockopt(socket, IPPROTO_TCP, TCP_INFO, &info, &size) == 0 ? info.tcpi_bytes_received : 0;
}
}  // namespace scanloom
