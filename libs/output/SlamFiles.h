/** The files of a localisation run, written while it goes: an interrupted run leaves what it had. */
#pragma once
#include "mrpt_bridge/RecordingHeader.h"
#include "output/MapPicture.h"
#include "output/OctoMapExport.h"
#include "output/OutputFile.h"
#include "output/PlyWriter.h"
#include "output/RunSummary.h"
#include "output/SimpleMapFile.h"
#include "output/Trajectory.h"
#include "slam/StateEstimate.h"

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
/**
 * trajectory.tum (a pose per processed scan), trajectory_imu.tum (at the IMU's rate), trajectory.csv (health and
 * registration per pose), keyframes.simplemap, map.ply, map.bt, map.ot, map.png and summary.json, all in the map frame,
 * every pose at the instant of its stamp.
 */
class SlamFiles
{
 public:
  /** All names that close() leaves in the folder. */
  static std::vector<std::string> names();

  /** Creates the folder. Throws std::runtime_error if it cannot be written. */
  SlamFiles(const std::filesystem::path& folder, const std::vector<RecordedLidar>&, const OctoMapOptions&);
  SlamFiles(const SlamFiles&) = delete;
  SlamFiles& operator=(const SlamFiles&) = delete;
  ~SlamFiles();

  /**
   * Poses are on disk when it returns. Keyframes join the maps in a thread of their own, in order, because an occupancy
   * map takes seconds for one; when eight wait it waits, too.
   */
  void add(const StateEstimate&);

  /** Writes the maps and the summary, completed by what was counted here, and gives every file its name. */
  void close(RunSummary);

 private:
  void enqueue(Keyframe);
  void drawMaps();
  void finishMaps();
  void addKeyframe(const Keyframe&);

  std::filesystem::path folder_;
  TumWriter trajectory_, trajectory_imu_;
  OutputFile csv_;
  PlyWriter ply_;
  SimpleMapBuilder simple_map_;
  OctoMapBuilder octomap_;
  MapPicture picture_;
  Trajectory poses_;
  StageTimes times_;  // of the thread that draws

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Keyframe> keyframes_;
  bool no_more_ = false;
  std::exception_ptr error_;
  std::thread thread_;  // draws
};
}  // namespace scanloom
