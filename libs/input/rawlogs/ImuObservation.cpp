#include "input/rawlogs/ImuObservation.h"

#include "input/rawlogs/Conversions.h"

#include <cmath>
#include <cstring>

namespace scanloom
{
namespace
{
/** MRPT reads bytes of the file as bools: a damaged one is neither true nor false, and must not be asked by has(). */
bool isMeasured(const mrpt::obs::CObservationIMU& observation, mrpt::obs::TIMUDataIndex axis)
{
  std::uint8_t present = 0;
  std::memcpy(&present, &observation.dataIsPresent[axis], sizeof present);
  return present == 1 && std::isfinite(observation.rawMeasurements[axis]);
}
}  // namespace

mrpt::obs::CObservationIMU::Ptr toObservation(const ImuSample& sample, const Rigid& body_T_imu,
                                              const std::string& label)
{
  auto observation = mrpt::obs::CObservationIMU::Create();
  observation->sensorLabel = label;
  observation->timestamp = toMrpt(sample.stamp);
  observation->sensorPose = toMrpt(body_T_imu);
  observation->set(mrpt::obs::IMU_X_ACC, sample.accel.x());
  observation->set(mrpt::obs::IMU_Y_ACC, sample.accel.y());
  observation->set(mrpt::obs::IMU_Z_ACC, sample.accel.z());
  observation->set(mrpt::obs::IMU_WX, sample.gyro.x());
  observation->set(mrpt::obs::IMU_WY, sample.gyro.y());
  observation->set(mrpt::obs::IMU_WZ, sample.gyro.z());
  return observation;
}

std::optional<RecordedImu> fromObservation(const mrpt::obs::CObservationIMU& observation)
{
  using namespace mrpt::obs;
  for (const auto axis : {IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC, IMU_WX, IMU_WY, IMU_WZ})
    if (!isMeasured(observation, axis)) return std::nullopt;

  const auto& values = observation.rawMeasurements;
  RecordedImu imu;
  imu.sample.stamp = fromMrpt(observation.timestamp);
  imu.sample.accel = {values[IMU_X_ACC], values[IMU_Y_ACC], values[IMU_Z_ACC]};
  imu.sample.gyro = {values[IMU_WX], values[IMU_WY], values[IMU_WZ]};
  imu.body_T_imu = fromMrpt(observation.sensorPose);
  imu.label = observation.sensorLabel;
  return imu;
}
}  // namespace scanloom
