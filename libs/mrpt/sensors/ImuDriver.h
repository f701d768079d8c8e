/** The IMU samples of an MRPT sensor, which is run as rawlog-grabber runs it. */
#pragma once
#include "base/core/ImuSample.h"
#include "base/core/Rigid.h"

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/hwdrivers/CGenericSensor.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace scanloom
{
/**
 * A thread of its own calls the sensor's doProcess() at `process_rate` and keeps each CObservationIMU with angular
 * rates and accelerations. The section's `driver` names the sensor's class, of MRPT or of a plugin that was loaded
 * before.
 */
class ImuDriver
{
 public:
  /** Throws std::runtime_error naming the section if there is no such class, or if the sensor does not start. */
  ImuDriver(const mrpt::config::CConfigFileBase&, const std::string& section);
  ImuDriver(const ImuDriver&) = delete;
  ImuDriver& operator=(const ImuDriver&) = delete;
  ~ImuDriver();

  /** The pose that comes with the samples. Waits for the first one; throws std::runtime_error if none comes. */
  Rigid body_T_imu(Duration patience);

  /** The samples since the last call, at most those of ten minutes at 1 kHz. */
  std::vector<ImuSample> take();

  /** Why the sensor gives no more samples, if it failed; only once. */
  std::optional<std::string> takeFailure();

 private:
  void run();
  void keep(const mrpt::hwdrivers::CGenericSensor::TListObservations&);

  std::string section_;
  mrpt::hwdrivers::CGenericSensor::Ptr sensor_;
  std::mutex mutex_;
  std::vector<ImuSample> samples_;
  std::optional<Rigid> body_T_imu_;
  std::string failure_;
  bool failed_ = false;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};
}  // namespace scanloom
