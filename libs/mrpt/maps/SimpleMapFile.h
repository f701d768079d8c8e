/**
 * keyframes.simplemap, for robot-map-gui and MOLA's sm2mm. Each keyframe is a pose with its covariance and one
 * CObservationPointCloud per lidar, after the IMU's reading as CObservationIMU: its label is the lidar's name, its
 * points are in the lidar's frame at the keyframe's stamp, its sensorPose is body_T_sensor. The clouds are
 * CGenericPointsMap (intensity 0 to 255, ring, t = 0: deskewed), which MRPT reads from 2.15.3 on, and older ones with
 * our plugin; or CPointsMapXYZI (intensity 0 to 1), which MRPT 2 reads without it, and MRPT 3 does not have.
 */
#pragma once
#include "base/core/Keyframe.h"
#include "base/core/MountedLidar.h"
#include "input/rawlogs/ImuObservation.h"
#include "mrpt/observations/Observations.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mrpt::maps
{
class CSimpleMap;
}

namespace scanloom
{
/** A keyframe with what a run knows of it besides. */
struct MeasuredKeyframe
{
  Keyframe keyframe;
  /** Of boxMinus(truth, map_T_body): translation (m), rotation (rad), along the body's axes. 0: not known. */
  Matrix6d covariance = Matrix6d::Zero();
  std::optional<RecordedImu> imu{};  // at its stamp
};

class SimpleMapBuilder
{
 public:
  /** Lidars by sensor id. Throws std::invalid_argument for a class that this MRPT does not have. */
  explicit SimpleMapBuilder(std::vector<MountedLidar>, CloudClass = CloudClass::CGenericPointsMap);
  ~SimpleMapBuilder();

  /** Throws std::invalid_argument if a point's sensor_id has no lidar. A lidar without points gives no observation. */
  void add(const MeasuredKeyframe&);

  /** Gzipped; the same bytes for the same keyframes. Throws std::runtime_error if it cannot be written. */
  void write(const std::filesystem::path&) const;

 private:
  std::vector<MountedLidar> lidars_;
  CloudClass cloud_class_;
  std::unique_ptr<mrpt::maps::CSimpleMap> map_;
};
}  // namespace scanloom
