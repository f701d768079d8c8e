/** The files of a localisation run, written during the run: an interrupted run keeps what it has written. */
#pragma once
#include "base/core/OutputFile.h"
#include "base/formats/Trajectory.h"
#include "estimation/slam/StateEstimate.h"
#include "run/run/OutputOptions.h"
#include "run/run/internal/DenseMap.h"
#include "run/run/internal/RunSummary.h"
#include "run/run/internal/SlamMaps.h"

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * trajectory.tum (a pose per processed scan), trajectory_imu.tum (poses at the IMU's rate), trajectory.csv (health and
 * registration per pose), summary.json and the maps, all in the map frame. Where the drive is found in the map of an
 * earlier run, all but trajectory.csv begin anew: no file has poses of two frames, and only the csv, which has none,
 * tells of those before.
 */
class SlamFiles
{
 public:
  /** All files that close() completes in the folder, the summary last. */
  static std::vector<std::string> names(const OutputOptions&);

  /** Creates the folder. Throws std::runtime_error on failure, and as DenseMap does. */
  SlamFiles(const std::filesystem::path& folder, const std::vector<RecordedLidar>&, const OutputOptions&);

  /**
   * The maps hold the keyframes of an earlier run, too, if the drive is found in its map. `lidars`: that run's, by the
   * keyframes' sensor ids. Throws UsageError where they are not among these.
   */
  void grow(const std::filesystem::path& keyframes, const std::vector<MountedLidar>& lidars);

  /** Writes the poses at once. Throws std::runtime_error if the disk does not take them. */
  void add(const StateEstimate&);

  /** What a person has marked is written with the first pose at that time or later. */
  void add(const EventMark& mark) { marks_.push_back(mark); }

  /**
   * Writes the maps, adds the path length, the memory and the maps that failed to the summary, and renames every file
   * to its name. Returns the summary as it was written.
   */
  RunSummary close(RunSummary);

 private:
  /** Of the run in whose map the drive is localised. */
  struct EarlierKeyframes
  {
    std::filesystem::path file;
    std::vector<std::uint8_t> sensor_ids;  // in the drive, by those in the file
  };

  void begin();
  std::string marksUntil(Timestamp);
  void extendPath(const StampedPose&);
  void addEarlierKeyframes();
  void closePoses();
  void closePosesAfterFailure();

  std::filesystem::path folder_;
  std::vector<RecordedLidar> lidars_;
  OutputOptions output_;
  std::optional<TumWriter> trajectory_, trajectory_imu_;  // there always is one
  OutputFile csv_;
  bool in_map_ = false;  // the frame of the files is that of an earlier run's map
  std::optional<EarlierKeyframes> earlier_;
  Trajectory path_;  // the newest pose and earlier ones at least 0.05 m apart, so that a rest does not fill the memory
  double path_length_ = 0;
  std::deque<EventMark> marks_;  // not yet written
  std::optional<SlamMaps> maps_;
  std::optional<DenseMap> dense_map_;
};
}  // namespace scanloom
