#pragma once
#include "estimation/slam/StateEstimate.h"
#include "input/rig/SensorInput.h"
#include "run/page/internal/LiveExchange.h"

#include <deque>
#include <map>

namespace scanloom
{
/** Whose work is shown. */
struct ViewedWork
{
  std::string verb;
  bool live = false;       // lidars, not a recording
  bool localised = false;  // scans wait for their estimate
};

/** How the work goes. */
struct FeedProgress
{
  double recorded = 0;  // s of the sensors' time that was processed
  double busy = 0;      // s of wall-clock time that this took, without waiting for input
};

/**
 * The working thread's side of the page. Used from one thread; nothing in it waits: see LiveExchange. What is shown
 * never goes back into the work.
 */
class LiveFeed
{
 public:
  using Clock = std::chrono::steady_clock;

  LiveFeed(LiveExchange&, const ViewedWork&);

  void add(const Scan&, const RecordingHeader&);
  void add(const SensorImu&, const RecordingHeader&);
  void add(const StateEstimate&);
  void add(const EventMark&);

  /** A part of the map, besides the keyframes of estimates. */
  void addMap(const Keyframe&);
  void update(const RigAccount&, const FeedProgress&, Clock::time_point now = Clock::now());
  void warn(const std::string&, Clock::time_point now = Clock::now());
  void show(const PlayerStatus&);

  /** A recording is played from another place: what was drawn so far is forgotten. */
  void restart();

  /** No more will come. */
  void end();

  /** Hands over what there is, if the lock is free. */
  void offer(Clock::time_point now = Clock::now());

  /** An event that a person marked on the page; none before the first scan, without which it would have no time. */
  std::optional<EventMark> takeMark();
  std::vector<std::string> takeCommands();

 private:
  struct Received
  {
    std::uint64_t packets = 0, columns = 0, points = 0;  // at the begin of the second that is counted
    std::uint64_t all_columns = 0, all_points = 0;
    int beams = 0;
  };
  struct ReceivedImu
  {
    std::uint64_t samples = 0;
    Timestamp since;
  };

  void watchLidars(const Scan&, const RecordingHeader&);
  void rateLidars(const RigAccount&, double seconds, bool packets);
  void addPath(const StateEstimate&);

  LiveExchange& exchange_;
  bool localised_;
  ViewStatus status_;
  LiveNews news_;
  std::deque<std::string> marks_;  // not taken yet
  std::vector<std::string> commands_;
  std::deque<PlacedCloud> waiting_;  // scans without their pose
  std::vector<Received> received_;   // by sensor id
  std::map<int, ReceivedImu> received_imus_;
  std::optional<StampedPose> last_;
  std::optional<PathPoint> last_path_;
  Clock::time_point rated_{}, offered_{};
  FeedProgress rated_progress_;
};
}  // namespace scanloom
