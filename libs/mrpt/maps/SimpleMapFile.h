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
#include "base/core/OutputFile.h"
#include "input/rawlogs/ImuObservation.h"
#include "mrpt/observations/GzipArchive.h"
#include "mrpt/observations/Observations.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

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

/** Keyframes go to the file as they come: no more than one of them is in memory. */
class SimpleMapWriter
{
 public:
  /**
   * Lidars by sensor id. Throws std::invalid_argument for a class that this MRPT does not have, std::runtime_error if
   * the folder cannot be written.
   */
  SimpleMapWriter(const std::filesystem::path&, std::vector<MountedLidar>, CloudClass = CloudClass::CGenericPointsMap);

  /**
   * Throws std::invalid_argument if a point's sensor_id has no lidar, std::runtime_error if the keyframe cannot be
   * written. A lidar without points gives no observation.
   */
  void add(const MeasuredKeyframe&);

  /** The file gets its name. Gzipped; the same bytes for the same keyframes. Throws std::runtime_error. */
  void close();

 private:
  std::vector<MountedLidar> lidars_;
  CloudClass cloud_class_;
  OutputFile file_;
  GzipArchive archive_;  // of file_
  std::uint32_t keyframes_ = 0;
};
}  // namespace scanloom
