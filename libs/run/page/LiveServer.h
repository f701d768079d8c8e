#pragma once
#include "run/page/internal/HttpServer.h"
#include "run/page/internal/LiveExchange.h"
#include "run/page/internal/LiveMap.h"
#include "run/page/internal/PageFiles.h"
#include "run/page/internal/ViewStatusJson.h"

#include <atomic>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

namespace scanloom
{
struct LiveServerOptions
{
  double most_bits_per_second = 5e6;  // of points, for each page
  int most_pages = 8;
  std::filesystem::path folder = ".";  // whose disk space is shown
};

/**
 * Shows what a LiveFeed hands over. All its threads yield to others, and each page is composed when it is sent: one
 * that reads slowly gets fewer scans and costs no more memory.
 *
 *     GET /         the page and its files
 *     GET /status   server-sent events: JSON (toJson), four a second
 *     GET /points   messages of LiveMap, ten times a second, without end
 *     POST /mark    the text of an event, up to kMostMarkBytes; changes nothing but the marks
 *     POST /player  PlayerCommand, where a recording is played
 */
class LiveServer
{
 public:
  static constexpr std::size_t kMostMarkBytes = 200;

  /** The exchange must outlive it. Throws what readPage() and HttpServer throw. */
  LiveServer(const SensorAddress&, LiveExchange&, const LiveServerOptions& = {});
  ~LiveServer();

  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  /** "http://127.0.0.1:8080" */
  std::string url() const { return server_.url(); }
  const SensorAddress& address() const { return server_.address(); }

 private:
  void answer(const HttpRequest&, HttpReply&);
  void sendStatus(HttpReply&);
  void sendPoints(HttpReply&);
  void mark(const HttpRequest&, HttpReply&);
  void command(const HttpRequest&, HttpReply&);
  void collect();

  LiveExchange& exchange_;
  LiveServerOptions options_;
  PageFiles files_;
  std::mutex map_mutex_;
  LiveMap map_;                                // guarded
  std::atomic<int> statuses_{0}, viewers_{0};  // that are open
  std::atomic<bool> stopping_{false};
  std::thread collector_;
  HttpServer server_;  // last: its threads use all of the above
};
}  // namespace scanloom
