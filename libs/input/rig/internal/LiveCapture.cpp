#include "input/rig/internal/LiveCapture.h"

#include "base/core/NewFile.h"

#include <fmt/format.h>
#include <pthread.h>

#include <chrono>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
using Clock = std::chrono::steady_clock;

constexpr auto kFlushPeriod = 1s;

// Datagrams are written in portions: the payloads of one are used again while the next one is written.
constexpr auto kPortion = 50ms;

}  // namespace

std::filesystem::path newCapture(const std::filesystem::path& path)
{
  if (isTaken(path))  // also a link, which would be followed
    throw std::runtime_error(fmt::format("{} exists: give another pcap_output, or move it away", path.string()));
  return path;
}

LiveCapture::LiveCapture(const std::filesystem::path& path, std::size_t memory)
  : memory_(memory), writer_(newCapture(path)), thread_([this] { write(); })
{
  ::pthread_setname_np(thread_.native_handle(), "scanloom-pcap");
}

LiveCapture::~LiveCapture() { close(); }

void LiveCapture::add(const DatagramView& view)
{
  Datagram datagram{view.received, view.source, view.source_port, view.destination_port, {}};
  {
    const std::lock_guard lock(mutex_);
    if (bytes_waiting_ + view.payload.size() > memory_ || !failure_.empty())
    {
      ++dropped_;
      return;
    }
    if (!spare_.empty())
    {
      datagram.payload = std::move(spare_.back());
      spare_.pop_back();
    }
  }
  datagram.payload.assign(view.payload.begin(), view.payload.end());
  const std::lock_guard lock(mutex_);
  bytes_waiting_ += datagram.payload.size();
  waiting_.push_back(std::move(datagram));
}

void LiveCapture::write()
{
  std::deque<Datagram> portion;
  Clock::time_point flushed = Clock::now();
  for (bool last = false; !last;)
  {
    {
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, kPortion, [this] { return closing_; });
      last = closing_;
      portion.swap(waiting_);
    }
    try
    {
      writeAll(portion);
      if (last) writer_.close();
      if (!last && Clock::now() - flushed >= kFlushPeriod)
      {
        writer_.flush();
        flushed = Clock::now();
      }
    }
    catch (const std::exception& error)
    {
      const std::lock_guard lock(mutex_);
      failure_ = error.what();
      dropped_ += portion.size();
      return;
    }
  }
}

/** Takes each datagram out of `portion` once it is written. */
void LiveCapture::writeAll(std::deque<Datagram>& portion)
{
  while (!portion.empty())
  {
    writer_.write(portion.front());
    const std::lock_guard lock(mutex_);
    bytes_waiting_ -= portion.front().payload.size();
    spare_.push_back(std::move(portion.front().payload));
    portion.pop_front();
  }
}

void LiveCapture::close()
{
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

std::string LiveCapture::takeFailure()
{
  const std::lock_guard lock(mutex_);
  if (failure_.empty() || std::exchange(failure_taken_, true)) return {};
  return failure_;
}
}  // namespace scanloom
