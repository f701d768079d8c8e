#include "input/packets/SensorHttp.h"

#include "base/core/Text.h"
#include "input/packets/internal/bytesReceived.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <thread>

namespace scanloom
{
namespace
{
using Clock = std::chrono::steady_clock;

constexpr int kOk = 200, kNotFound = 404, kMethodNotAllowed = 405;

// Beside the answer itself.
constexpr std::uint64_t kMostBytesOfHeaders = 64 * 1024;

// How often it is looked at how much has been received.
constexpr auto kLook = 5ms;

// The text of an error answer is shown up to this length.
constexpr std::size_t kShownOfAnError = 120;

std::string shown(const std::string& text)
{
  return printable(text.size() > kShownOfAnError ? text.substr(0, kShownOfAnError) + "..." : text);
}

/** Writing to a connection that was just closed raises SIGPIPE, which would end the program: blocks it in this thread.
 */
class BrokenPipesAreErrors
{
 public:
  BrokenPipesAreErrors()
  {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~BrokenPipesAreErrors()
  {
    const timespec at_once{};
    if (!sigismember(&before_, SIGPIPE)) sigtimedwait(&pipe_, nullptr, &at_once);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

  BrokenPipesAreErrors(const BrokenPipesAreErrors&) = delete;
  BrokenPipesAreErrors& operator=(const BrokenPipesAreErrors&) = delete;

 private:
  sigset_t pipe_{}, before_{};
};
}  // namespace

/**
 * The library limits the time of single reads only: with a sensor that sends a byte per second a request would take
 * hours. Nor does it limit how many headers it stores. So a thread closes the connection when the time is over, or when
 * more was received than an answer may have.
 */
class SensorHttp::Connection
{
 public:
  Connection(const SensorAddress& address, const SensorHttpLimits& limits)
    : client_(address.ip.text(), address.port),
      deadline_(Clock::now() + limits.time),
      most_bytes_(limits.bytes + kMostBytesOfHeaders)
  {
    client_.set_keep_alive(true);
    client_.set_follow_location(false);
    client_.set_url_encode(false);  // it would encode the '+' of set_config_param as %2B
    client_.set_tcp_nodelay(true);
    client_.set_socket_options([this](int socket) { look(socket); });
    watch_ = std::thread([this] { cutAtTheLimits(); });
  }

  ~Connection()
  {
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    changed_.notify_all();
    watch_.join();
  }

  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  httplib::Result send(const httplib::Request& request)
  {
    const auto left = std::max<Clock::duration>(remaining(), 1ms);
    client_.set_connection_timeout(left);
    client_.set_read_timeout(left + 1s);  // longer than `left`, so that it is always our thread that ends the request
    client_.set_write_timeout(left + 1s);
    {
      const std::lock_guard lock(mutex_);
      received_before_ = bytesReceived(socket_);
      is_asking_ = true;
    }
    changed_.notify_all();
    const BrokenPipesAreErrors guard;
    httplib::Result result = client_.send(request);
    const std::lock_guard lock(mutex_);
    is_asking_ = false;
    return result;
  }

  /** More than the answer to the latest request may have. */
  bool isTooLarge() const
  {
    const std::lock_guard lock(mutex_);
    return is_too_large_;
  }

  bool expired() const { return remaining() <= Clock::duration::zero(); }

  void cancel()
  {
    {
      const std::lock_guard lock(mutex_);
      deadline_ = Clock::time_point::min();
    }
    changed_.notify_all();
  }

 private:
  /** From here on it is this socket's answer that is limited. */
  void look(int socket)
  {
    const std::lock_guard lock(mutex_);
    socket_ = socket;
    received_before_ = 0;
  }

  Clock::duration remaining() const
  {
    const std::lock_guard lock(mutex_);
    return deadline_ == Clock::time_point::min() ? Clock::duration::zero() : deadline_ - Clock::now();
  }

  void cutAtTheLimits()
  {
    std::unique_lock lock(mutex_);
    while (!done_)
    {
      is_too_large_ |= is_asking_ && bytesReceived(socket_) > received_before_ + most_bytes_;
      if (Clock::now() < deadline_ && !is_too_large_)
      {
        changed_.wait_until(lock, is_asking_ ? std::min(deadline_, Clock::now() + kLook) : deadline_);
        continue;
      }
      // Repeatedly: a request that was just about to be sent may open its connection after the first time.
      lock.unlock();
      client_.stop();
      lock.lock();
      changed_.wait_for(lock, 10ms, [this] { return done_; });
    }
  }

  httplib::Client client_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Clock::time_point deadline_;
  std::uint64_t most_bytes_;
  int socket_ = -1;
  std::uint64_t received_before_ = 0;  // the request under way
  bool is_asking_ = false, is_too_large_ = false;
  bool done_ = false;
  std::thread watch_;
};

SensorHttp::SensorHttp(const SensorAddress& address, const SensorHttpLimits& limits)
  : address_(address), limits_(limits), connection_(std::make_unique<Connection>(address, limits))
{
}

SensorHttp::~SensorHttp() = default;

std::optional<std::string> SensorHttp::get(const std::string& endpoint) { return request("GET", endpoint, ""); }

bool SensorHttp::post(const std::string& endpoint, const std::string& json)
{
  return request("POST", endpoint, json).has_value();
}

void SensorHttp::cancel() { connection_->cancel(); }

SensorHttpError SensorHttp::error(SensorFault fault, const std::string& endpoint, const std::string& problem) const
{
  return failure("GET " + endpoint, fault, problem);
}

SensorHttpError SensorHttp::failure(const std::string& request, SensorFault fault, const std::string& problem) const
{
  return {fault, fmt::format("sensor {}: {}: {}", address_.text(), request, problem)};
}

std::optional<std::string> SensorHttp::request(const char* method, const std::string& endpoint, const std::string& body)
{
  const auto fail = [&](SensorFault fault, const std::string& problem)
  { return failure(fmt::format("{} {}", method, endpoint), fault, problem); };
  const auto timedOut = [&]
  {
    return fail(SensorFault::TimedOut,
                fmt::format("no complete answer within {} s: is the sensor on and the network free? If it cannot be "
                            "asked, give its metadata as a file (key 'metadata')",
                            seconds(limits_.time)));
  };
  if (connection_->expired()) throw timedOut();

  std::string answer;
  httplib::Request asked;
  asked.method = method;
  asked.path = endpoint;
  asked.body = body;
  if (!body.empty()) asked.set_header("Content-Type", "application/json");
  asked.content_receiver = [&](const char* data, std::size_t size, std::uint64_t, std::uint64_t)
  {
    if (answer.size() + size > limits_.bytes) return false;
    answer.append(data, size);
    return true;
  };

  const httplib::Result result = connection_->send(asked);
  if (result.error() == httplib::Error::Canceled || connection_->isTooLarge())
    throw fail(SensorFault::TooLarge,
               fmt::format("the answer has more than {} bytes: this is no sensor's metadata", limits_.bytes));
  if (result.error() != httplib::Error::Success && connection_->expired()) throw timedOut();
  if (result.error() == httplib::Error::Connection)
    throw fail(SensorFault::Unreachable, "nobody answers there: check the address, the sensor's power and the network");
  if (result.error() != httplib::Error::Success)
    throw fail(SensorFault::Interrupted, "the connection ended before the answer did: is the sensor restarting?");

  if (result->status == kOk) return answer;
  if (result->status == kNotFound || result->status == kMethodNotAllowed) return std::nullopt;
  throw fail(SensorFault::Refused,
             fmt::format("answered {} {} '{}'", result->status, shown(result->reason), shown(answer)));
}
}  // namespace scanloom
