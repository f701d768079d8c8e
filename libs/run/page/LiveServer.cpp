#include "run/page/LiveServer.h"

#include "base/core/Text.h"
#include "run/page/internal/PlayerCommand.h"
#include "run/page/internal/yieldToAll.h"

#include <fmt/format.h>

#include <cmath>

namespace scanloom
{
namespace
{
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr const char* kText = "text/plain; charset=utf-8";
constexpr Clock::duration kScanEvery = 100ms, kStatusEvery = 250ms, kCollectEvery = 50ms;
constexpr std::size_t kMostUntaken = 100;  // marks or commands on their way to the working thread

/** One of a limited number; given back at the end of the answer. */
class Place
{
 public:
  Place(std::atomic<int>& taken, int most) : taken_(taken), has_(++taken <= most) {}
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  ~Place() { --taken_; }

  explicit operator bool() const { return has_; }

 private:
  std::atomic<int>& taken_;
  bool has_;
};
}  // namespace

LiveServer::LiveServer(const SensorAddress& address, LiveExchange& exchange, const LiveServerOptions& options)
  : exchange_(exchange),
    options_(options),
    files_(readPage()),
    server_(address, [this](const HttpRequest& request, HttpReply& reply) { answer(request, reply); })
{
  collector_ = std::thread([this] { collect(); });
}

LiveServer::~LiveServer()
{
  stopping_ = true;
  collector_.join();
}

void LiveServer::collect()
{
  yieldToAll();
  for (; !stopping_; std::this_thread::sleep_for(kCollectEvery))
  {
    LiveNews news;
    {
      const std::lock_guard lock(exchange_.mutex);
      std::swap(news, exchange_.news);
    }
    const std::lock_guard lock(map_mutex_);
    map_.add(news);
  }
}

void LiveServer::answer(const HttpRequest& request, HttpReply& reply)
{
  const bool posted = request.method == "POST";
  if (request.path == "/mark" || request.path == "/player")
  {
    if (!posted) throw BadRequest(kHttpNotAllowed, "this must be a POST");
    return request.path == "/mark" ? mark(request, reply) : command(request, reply);
  }
  if (posted) throw BadRequest(kHttpNotAllowed, "nothing here can be changed");
  if (request.path == "/status") return sendStatus(reply);
  if (request.path == "/points") return sendPoints(reply);
  const auto file = files_.find(request.path);
  if (file == files_.end()) throw BadRequest(kHttpNotFound, "there is no such page");
  reply.send(kHttpOk, file->second.type, file->second.bytes);
}

void LiveServer::sendStatus(HttpReply& reply)
{
  const Place place(statuses_, options_.most_pages);
  if (!place) throw BadRequest(kHttpBusy, fmt::format("{} pages are open already", options_.most_pages));
  if (!reply.beginStream("text/event-stream")) return;
  const auto event = [this]
  {
    ViewStatus status;
    {
      const std::lock_guard lock(exchange_.mutex);
      status = exchange_.status;
    }
    return "data: " + toJson(status, computerStatus(options_.folder), Clock::now()) + "\n\n";
  };
  while (reply.write(event()) && reply.pause(kStatusEvery)) continue;
  reply.write(event());  // how it ended
}

void LiveServer::sendPoints(HttpReply& reply)
{
  const Place place(viewers_, options_.most_pages);
  if (!place) throw BadRequest(kHttpBusy, fmt::format("{} pages are open already", options_.most_pages));
  if (!reply.beginStream("application/octet-stream")) return;
  constexpr double kBitsPerByte = 8;
  const double bytes_per_part =
      options_.most_bits_per_second / kBitsPerByte * std::chrono::duration<double>(kScanEvery).count();
  SeenByPage seen;
  Clock::time_point next = Clock::now();
  do {
    std::string messages;
    {
      const std::lock_guard lock(map_mutex_);
      messages = map_.lackedBy(seen, static_cast<std::size_t>(bytes_per_part));
    }
    if (!reply.write(messages)) return;
    // A part that was larger, or that was slowly taken, is made up for by waiting.
    const double parts = std::max(1.0, static_cast<double>(messages.size()) / bytes_per_part);
    next += std::chrono::duration_cast<Clock::duration>(parts * kScanEvery);
    next = std::max(next, Clock::now());
  } while (reply.pause(next - Clock::now()));
}

void LiveServer::mark(const HttpRequest& request, HttpReply& reply)
{
  if (request.body.size() > kMostMarkBytes)
    throw BadRequest(kHttpBadRequest, fmt::format("the text of a mark has at most {} bytes", kMostMarkBytes));
  {
    const std::lock_guard lock(exchange_.mutex);
    if (exchange_.status.player) throw BadRequest(kHttpConflict, "a recording that is played takes no marks");
    if (exchange_.marks.size() >= kMostUntaken) throw BadRequest(kHttpBusy, "too many marks at once");
    exchange_.marks.push_back(printable(request.body));
  }
  reply.send(kHttpOk, kText, "marked\n");
}

void LiveServer::command(const HttpRequest& request, HttpReply& reply)
{
  if (!parsePlayerCommand(request.body))
    throw BadRequest(kHttpBadRequest, "play, pause, step, speed NUMBER or seek SECONDS is expected");
  {
    const std::lock_guard lock(exchange_.mutex);
    if (!exchange_.status.player) throw BadRequest(kHttpNotFound, "nothing is played");
    if (exchange_.commands.size() >= kMostUntaken) throw BadRequest(kHttpBusy, "too many commands at once");
    exchange_.commands.push_back(request.body);
  }
  reply.send(kHttpOk, kText, "done\n");
}
}  // namespace scanloom
