/** A drive again and again, until the IMU's pose by which it is localised is the one that it tells. */
#pragma once
#include "calibration/ImuExtrinsicsEstimate.h"
#include "run/run/internal/CalibrationDrive.h"

#include <functional>
#include <memory>

namespace scanloom
{
/** The same recording from its begin. */
using OpenInput = std::function<std::unique_ptr<SensorInput>()>;

struct ImuCalibration
{
  CalibrationDrive drive;  // the last one; of no use if the IMU contradicts
  ImuExtrinsicsEstimate imu;
};

/**
 * First without the IMU: turns tell its rotation and clock (imuExtrinsicsByTurns). Then it only deskews: registrations
 * tell its pose (estimateImuExtrinsics), once more where that is far from the one before. The last drive is as any
 * other, with the pose found; there is none where the drive shows nothing of it. The IMU is that of the body. Throws as
 * runSlam does.
 */
ImuCalibration calibrateImu(const OpenInput&, std::size_t reference, const SlamSettings&, const Extrinsics& given,
                            const KeepGoing&, const Warn&);
}  // namespace scanloom
