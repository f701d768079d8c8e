#include "support/DatagramStream.h"

#include <algorithm>

#include "input/packets/CaptureReader.h"

namespace scanloom
{
namespace
{
using Clock = std::chrono::steady_clock;
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
  : sender_(source)
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
    const bool done = sender_.send(datagram, destination);
    ++(done ? sent_ : refused_);
  }
}
}  // namespace scanloom
