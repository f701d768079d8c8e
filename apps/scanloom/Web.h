/** --web: a page that shows what a verb does (doc/live_view.md). */
#pragma once
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

  bool given() const { return !address.empty(); }
};

/** Adds --web [ADDRESS:PORT]. */
void addWeb(CLI::App&, WebArguments&);

/** The default one if none is given. Throws UsageError for what is no ADDRESS:PORT. */
SensorAddress webAddress(const WebArguments&);

/** The page of one run. */
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
  LiveServer server_;
  LiveFeed::Clock::time_point accounted_{};
};

/** Null if none is wanted. */
std::unique_ptr<Web> openWeb(const WebArguments&, const ViewedWork&, SensorInput&, const std::filesystem::path& folder);

/** Says on stderr where the page is, and a warning if other computers reach it. */
void announcePage(const std::string& url, const SensorAddress&);
}  // namespace scanloom
