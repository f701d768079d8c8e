#include "simulation/DatagramStream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "source/CaptureReader.h"
#include "source/SocketAddress.h"

namespace scanloom
{
namespace
{
using Clock = std::chrono::steady_clock;

FileDescriptor openSocket(const IpAddress& source)
{
  const SocketAddress own = SocketAddress::of(source, 0);
  FileDescriptor socket(::socket(own.storage.ss_family, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (socket.isOpen() && ::bind(socket.number(), own.get(), own.length) == 0) return socket;
  throw std::runtime_error(fmt::format("no UDP socket can be bound to {}: {}", source.text(), std::strerror(errno)));
}
}  // namespace

std::vector<Datagram> readDatagrams(const std::filesystem::path& capture, const std::string& source)
{
  CaptureReader reader(capture);
  std::vector<Datagram> datagrams;
  for (Datagram datagram; reader.next(datagram);)
    if (source.empty() || datagram.source == IpAddress::parse(source)) datagrams.push_back(datagram);
  return datagrams;
}

DatagramStream::DatagramStream(std::vector<Datagram> datagrams, const IpAddress& source, const StreamOptions& options)
  : socket_(openSocket(source))
{
  const IpAddress destination = IpAddress::parse(options.destination);
  thread_ = std::thread([this, datagrams = std::move(datagrams), destination, options]
                        { run(datagrams, destination, options); });
}

DatagramStream::~DatagramStream()
{
  stop_ = true;
  wait();
}

void DatagramStream::wait()
{
  if (thread_.joinable()) thread_.join();
}

void DatagramStream::run(const std::vector<Datagram>& datagrams, const IpAddress& destination,
                         const StreamOptions& options)
{
  constexpr Clock::duration kLongestSleep = 20ms;  // so that an end is not waited for
  if (datagrams.empty()) return;
  const Timestamp origin = options.origin == Timestamp{} ? datagrams.front().received : options.origin;
  for (const Datagram& datagram : datagrams)
  {
    const Duration after = fromSeconds(seconds(datagram.received - origin) / options.speed);
    const Clock::time_point due = options.start + after;
    while (!stop_ && Clock::now() < due) std::this_thread::sleep_until(std::min(due, Clock::now() + kLongestSleep));
    if (stop_) return;
    const SocketAddress to = SocketAddress::of(destination, datagram.destination_port);
    const auto size = static_cast<ssize_t>(datagram.payload.size());
    const bool done =
        ::sendto(socket_.number(), datagram.payload.data(), datagram.payload.size(), 0, to.get(), to.length) == size;
    ++(done ? sent_ : refused_);
  }
}
}  // namespace scanloom
