/** Between the thread that works and those that show what it does. */
#pragma once
#include "base/core/PointCloud.h"
#include "base/core/Rigid.h"
#include "run/page/internal/ViewStatus.h"

#include <mutex>
#include <vector>

namespace scanloom
{
/** Few of the points of a cloud. */
struct ThinCloud
{
  std::vector<Eigen::Vector3f> positions;  // m, body frame, each at its own time
  std::vector<std::int32_t> t;             // ns after the owner's stamp
  std::vector<std::uint8_t> reflectivity, lidar;

  std::size_t size() const { return positions.size(); }
};

/** At most `most` points of the cloud, evenly from all of it. */
ThinCloud thinned(const PointCloud&, std::size_t most);

/** A cloud, and where the body was at the begin and the end of its `period`. */
struct PlacedCloud
{
  Timestamp start;
  Duration period{0};
  Rigid map_T_begin, map_T_end;
  ThinCloud points;
};

/** In place of a health: a new path begins here. */
constexpr std::uint8_t kPathBreak = 255;

struct PathPoint
{
  Eigen::Vector3f position;  // m, map frame
  std::uint8_t health = 0;   // as enum Health, or kPathBreak
};

/** What the working thread has for the others. */
struct LiveNews
{
  std::vector<PlacedCloud> scans, keyframes;
  std::vector<PathPoint> path;
  bool restarted = false;  // forget all that was shown before these

  void append(LiveNews);
};

/**
 * The working thread only ever tries the lock: a thread of the page that holds it, and waits for a processor, costs it
 * nothing. What it could not hand over it keeps until the next try; of scans the newest, of keyframes the newest few.
 */
struct LiveExchange
{
  std::mutex mutex;
  ViewStatus status;                  // guarded
  LiveNews news;                      // guarded
  std::vector<std::string> marks;     // guarded; texts, on their way to the working thread
  std::vector<std::string> commands;  // guarded; for a player
};
}  // namespace scanloom
