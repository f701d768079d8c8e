/** The maps of a localisation run, drawn from its keyframes during the run. */
#pragma once
#include "base/core/BoundedQueue.h"
#include "base/formats/CloudWriter.h"
#include "base/formats/Trajectory.h"
#include "input/rig/RecordingHeader.h"
#include "mrpt/maps/KeyframeTable.h"
#include "mrpt/maps/MapPicture.h"
#include "mrpt/maps/SimpleMapFile.h"
#include "run/run/internal/RunSummary.h"

#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** keyframes.simplemap and keyframes.csv, map.ply and map.png, all in the map frame. */
class SlamMaps
{
 public:
  /** All files that close() completes in the folder. */
  static std::vector<std::string> names();

  /** Throws std::runtime_error if the folder cannot be written. */
  SlamMaps(const std::filesystem::path& folder, const std::vector<RecordedLidar>&, CloudClass of_keyframes);
  SlamMaps(const SlamMaps&) = delete;
  SlamMaps& operator=(const SlamMaps&) = delete;
  ~SlamMaps();

  /**
   * Keyframes are written by a thread of their own, in order: a scan does not wait for a disk. Waits while eight of
   * them wait.
   */
  void add(MeasuredKeyframe, const KeyframeRow&);

  /** Of an earlier drive in the same frame: not in keyframes.csv, which is of one drive. */
  void addEarlier(MeasuredKeyframe);

  /**
   * Waits for the last keyframe, renames every file to its name, and adds map points and stages to the summary. A map
   * that could not be written, because the disk is full for example, is left out and named in the summary's error.
   */
  void close(const Trajectory&, RunSummary&);

 private:
  void draw();
  void addToAll(const MeasuredKeyframe&);
  void writeAll(const Trajectory&);

  /** One step of a map. If it fails, the map is given up: its further steps are left out. */
  void attempt(const std::string& files, const std::function<void()>& step);

  std::filesystem::path folder_;
  CloudWriter ply_;
  KeyframeTableWriter table_;
  SimpleMapWriter simple_map_;
  MapPicture picture_;
  StageTimes times_;                             // of the thread
  std::map<std::string, std::string> failures_;  // by files

  BoundedQueue<MeasuredKeyframe> queue_;
  std::shared_future<void> drawn_;  // last: its thread uses all of the above, and it waits for that thread
};
}  // namespace scanloom
