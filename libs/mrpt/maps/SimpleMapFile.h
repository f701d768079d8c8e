/**
 * keyframes.simplemap, for robot-map-gui and MOLA's sm2mm. They load no plugins, so it has classes of MRPT only. Each
 * keyframe is a pose and one CObservationPointCloud (CPointsMapXYZI, intensity 0 to 1) per lidar: its label is the
 * lidar's name, its points are in the lidar's frame at the keyframe's stamp, its sensorPose is body_T_sensor.
 */
#pragma once
#include "base/core/Keyframe.h"
#include "base/core/MountedLidar.h"

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
/** The intensity of a scan that MRPT's intensity 1 stands for. */
inline constexpr float kFullIntensity = 255.0F;

class SimpleMapBuilder
{
 public:
  /** Lidars by sensor id. */
  explicit SimpleMapBuilder(std::vector<MountedLidar>);
  ~SimpleMapBuilder();

  /** Throws std::invalid_argument if a point's sensor_id has no lidar. A lidar without points gives no observation. */
  void add(const Keyframe&);

  /** Gzipped; the same bytes for the same keyframes. Throws std::runtime_error if it cannot be written. */
  void write(const std::filesystem::path&) const;

 private:
  std::vector<MountedLidar> lidars_;
  std::unique_ptr<mrpt::maps::CSimpleMap> map_;
};
}  // namespace scanloom
