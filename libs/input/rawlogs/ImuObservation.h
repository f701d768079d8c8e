/** IMU samples as MRPT's observations, and back. */
#pragma once
#include "base/core/ImuSample.h"
#include "base/core/Rigid.h"

#include <mrpt/obs/CObservationIMU.h>

#include <optional>
#include <string>

namespace scanloom
{
inline constexpr const char* kImuLabel = "imu";  // MOLA's default, so that its pipelines work without changes

struct RecordedImu
{
  ImuSample sample;
  Rigid body_T_imu;
  std::string label;
};

/** m/s2 and rad/s, sensorPose is body_T_imu. */
mrpt::obs::CObservationIMU::Ptr toObservation(const ImuSample&, const Rigid& body_T_imu,
                                              const std::string& label = kImuLabel);

/** Nothing if an axis of the accelerometer or the gyroscope is missing or not finite. */
std::optional<RecordedImu> fromObservation(const mrpt::obs::CObservationIMU&);
}  // namespace scanloom
