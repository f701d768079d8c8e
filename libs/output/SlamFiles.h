/** The files of a localisation run, written while it goes: an interrupted run leaves what it had. */
#pragma once
#include "output/OutputFile.h"
#include "output/RunSummary.h"
#include "output/SlamMaps.h"
#include "output/Trajectory.h"
#include "slam/StateEstimate.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct OutputOptions
{
  bool maps = true;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.maps,
          Field{"maps", "", "false: trajectories and summary alone, no keyframes, clouds, occupancy or picture"});
  }
};

/**
 * trajectory.tum (a pose per processed scan), trajectory_imu.tum (at the IMU's rate), trajectory.csv (health and
 * registration per pose), summary.json and the maps, all in the map frame, every pose at the instant of its stamp.
 */
class SlamFiles
{
 public:
  /** All names that close() leaves in the folder. */
  static std::vector<std::string> names();

  /** Creates the folder; no occupancy, no maps at all. Throws std::runtime_error if it cannot be written. */
  SlamFiles(const std::filesystem::path& folder, const std::vector<RecordedLidar>&,
            const std::optional<OctoMapOptions>&);

  /** Poses are on disk when it returns. */
  void add(const StateEstimate&);

  /** Writes the maps and the summary, completed by what was counted here, and gives every file its name. */
  void close(RunSummary);

 private:
  void extendWay(const StampedPose&);

  std::filesystem::path folder_;
  TumWriter trajectory_, trajectory_imu_;
  OutputFile csv_;
  Trajectory way_;  // the newest pose, and those before it some way apart: an hour at rest is no way
  double path_length_ = 0;
  std::optional<SlamMaps> maps_;
};
}  // namespace scanloom
