/**
 * keyframes.simplemap: opens in robot-map-gui and MOLA's sm2mm, which load no plugins, so every class inside is MRPT's
 * own. Each keyframe is a pose and one CObservationPointCloud (CPointsMapXYZI, intensity 0 to 1) per lidar, labelled
 * with the lidar's name, in the lidar's frame with its sensorPose, as if the whole scan had been measured at once.
 */
#pragma once
#include "core/Keyframe.h"
#include "core/MountedLidar.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace mrpt::maps
{
class CSimpleMap;
}

namespace scanloom
{
class SimpleMapBuilder
{
 public:
  /** Lidars by sensor id. */
  explicit SimpleMapBuilder(std::vector<MountedLidar>);
  ~SimpleMapBuilder();

  /** Throws std::invalid_argument if a point's sensor_id has no lidar. A lidar without points gives no observation. */
  void add(const Keyframe&);

  const mrpt::maps::CSimpleMap& map() const { return *map_; }

  /** gzipped, the same bytes for the same keyframes; throws std::runtime_error if it cannot be written. */
  void write(const std::filesystem::path&) const;

 private:
  std::vector<MountedLidar> lidars_;
  std::unique_ptr<mrpt::maps::CSimpleMap> map_;
};
}  // namespace scanloom
