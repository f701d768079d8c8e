/** The maps of a localisation run, drawn from its keyframes while it goes. */
#pragma once
#include "mrpt_bridge/RecordingHeader.h"
#include "output/MapPicture.h"
#include "output/OctoMapExport.h"
#include "output/PlyWriter.h"
#include "output/RunSummary.h"
#include "output/SimpleMapFile.h"
#include "output/Trajectory.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace scanloom
{
/** keyframes.simplemap, map.ply, map.bt, map.ot and map.png, all in the map frame. */
class SlamMaps
{
 public:
  /** All names that close() leaves in the folder. */
  static std::vector<std::string> names();

  /** Throws std::runtime_error if the folder cannot be written. */
  SlamMaps(const std::filesystem::path& folder, const std::vector<RecordedLidar>&, const OctoMapOptions&);
  SlamMaps(const SlamMaps&) = delete;
  SlamMaps& operator=(const SlamMaps&) = delete;
  ~SlamMaps();

  /**
   * Keyframes join the maps in a thread of their own, in order, because an occupancy map takes seconds for one; when
   * eight wait it waits, too.
   */
  void add(Keyframe);

  /** Waits for the last keyframe, gives every file its name, and completes the summary by what was counted here. */
  void close(const Trajectory&, RunSummary&);

 private:
  void draw();
  void addToAll(const Keyframe&);
  void finish();

  std::filesystem::path folder_;
  PlyWriter ply_;
  SimpleMapBuilder simple_map_;
  OctoMapBuilder octomap_;
  MapPicture picture_;
  StageTimes times_;  // of the thread

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Keyframe> keyframes_;
  bool no_more_ = false;
  std::exception_ptr error_;
  std::thread thread_;  // draws
};
}  // namespace scanloom
