/** --web and --window: a page or a window that shows what a verb does (doc/live_view.md). */
#pragma once
#include "Devices.h"
#include "Options.h"
#include "run/page/LiveServer.h"
#include "run/page/WatchedInput.h"

#include <filesystem>
#include <memory>
#include <string>

namespace scanloom
{
struct WebArguments
{
  std::string address;  // empty: no page
  bool window = false;

  bool given() const { return !address.empty() || window; }
};

/** Adds --web [ADDRESS:PORT]. */
Option addWeb(CLI::App&, WebArguments&);

/** Adds --window, which excludes --web: what was handed over is taken once. */
void addWindow(CLI::App&, const Option& web, WebArguments&);

/** Throws UsageError for what is no ADDRESS:PORT. */
SensorAddress webAddress(const WebArguments&);

/** The page or the window of one run. */
class Web
{
 public:
  /**
   * Prints where the page is, and a warning if other computers reach it. `folder`: whose disk space is shown. The input
   * must outlive it.
   */
  Web(const WebArguments&, const ViewedWork&, SensorInput&, const std::filesystem::path& folder);

  /** To be used in place of the input. */
  SensorInput& input() { return input_; }
  LiveFeed& feed() { return feed_; }

  /** To be called after each event, and when none came for a while. */
  void update(const FeedProgress& = {});

 private:
  LiveExchange exchange_;
  LiveFeed feed_;
  WatchedInput input_;
  std::unique_ptr<LiveServer> server_;
  std::unique_ptr<Window> window_;
  LiveFeed::Clock::time_point accounted_{};
};

/** Null if neither is wanted. */
std::unique_ptr<Web> openWeb(const WebArguments&, const ViewedWork&, SensorInput&, const std::filesystem::path& folder);

/** Says on stderr where the page is, and a warning if other computers reach it. */
void announcePage(const LiveServer&, const SensorAddress&);
}  // namespace scanloom
