#pragma once
#include <cstdint>

namespace scanloom
{
/** By a TCP connection since it was opened; 0 for anything else than the file descriptor of one. */
std::uint64_t bytesReceived(int socket);
}  // namespace scanloom
