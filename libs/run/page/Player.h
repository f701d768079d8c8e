#pragma once
#include "base/core/StampedPose.h"
#include "run/page/internal/LiveFeed.h"
#include "run/page/internal/PlayerCommand.h"

#include <functional>
#include <memory>

namespace scanloom
{
/** Plays a recording for pages, at the pace of its sensors or as they ask (PlayerCommand). */
class Player
{
 public:
  using Clock = std::chrono::steady_clock;
  using Open = std::function<std::unique_ptr<SensorInput>()>;

  /** `open` is called again to go back. Where there are poses, scans are drawn in the map, else about the body. */
  Player(Open open, Trajectory poses, LiveExchange&);

  /** Also waits for commands at the end of the recording; returns when `keepGoing` is false. */
  void run(const std::function<bool()>& keepGoing);

 private:
  void obey(const PlayerCommand&);
  void seek(double position);
  void playNext();
  void showScan(const Scan&);
  void showState();
  void keepPace();
  bool isDue() const;

  Open open_;
  Trajectory poses_;
  LiveFeed feed_;
  std::unique_ptr<SensorInput> input_;
  RecordingHeader header_;
  PlayerStatus status_;
  std::optional<double> wanted_;  // place that is sought
  bool one_scan_ = false;         // step
  std::optional<Timestamp> first_;
  std::optional<Rigid> last_keyframe_;
  Clock::time_point since_{};  // when it was at from_
  double from_ = 0;
};
}  // namespace scanloom
