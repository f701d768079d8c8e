#include "mrpt/sensors/ImuDriver.h"

#include "mrpt/observations/Observations.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
using mrpt::hwdrivers::CGenericSensor;

constexpr std::size_t kMostWaiting = 600'000;  // ten minutes at 1 kHz

CGenericSensor::Ptr started(const mrpt::config::CConfigFileBase& configuration, const std::string& section)
{
  const std::string driver = configuration.read_string(section, "driver", "");
  CGenericSensor::Ptr sensor = CGenericSensor::createSensorPtr(driver);
  if (!sensor)
    throw std::runtime_error(
        fmt::format("[{}] driver = {}: no such sensor in MRPT, nor in a plugin that was loaded", section, driver));
  try
  {
    sensor->loadConfig(configuration, section);
    sensor->initialize();
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error(fmt::format("[{}] {} does not start: {}", section, driver, error.what()));
  }
  return sensor;
}
}  // namespace

ImuDriver::ImuDriver(const mrpt::config::CConfigFileBase& configuration, const std::string& section)
  : section_(section), sensor_(started(configuration, section)), thread_([this] { run(); })
{
}

ImuDriver::~ImuDriver()
{
  stopping_ = true;
  thread_.join();
}

void ImuDriver::run()
{
  const double rate = std::max(1.0, sensor_->getProcessRate());
  try
  {
    while (!stopping_)
    {
      const auto next = std::chrono::steady_clock::now() + fromSeconds(1 / rate);
      sensor_->doProcess();
      keep(sensor_->getObservations());
      if (sensor_->getState() == CGenericSensor::ssError) throw std::runtime_error("the sensor reports an error");
      std::this_thread::sleep_until(next);
    }
  }
  catch (const std::exception& error)
  {
    const std::lock_guard lock(mutex_);
    failed_ = true;
    failure_ = fmt::format("[{}] gives no more samples: {}", section_, error.what());
  }
}

void ImuDriver::keep(const CGenericSensor::TListObservations& observations)
{
  const std::lock_guard lock(mutex_);
  for (const auto& [stamp, object] : observations)
  {
    const auto imu = std::dynamic_pointer_cast<mrpt::obs::CObservationIMU>(object);
    if (!imu) continue;
    const std::optional<RecordedImu> recorded = fromObservation(*imu);
    if (!recorded || samples_.size() >= kMostWaiting) continue;
    body_T_imu_ = recorded->body_T_imu;
    samples_.push_back(recorded->sample);
  }
}

Rigid ImuDriver::body_T_imu(Duration patience)
{
  constexpr Duration kLook = 10ms;
  const auto end = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < end)
  {
    {
      const std::lock_guard lock(mutex_);
      if (body_T_imu_) return *body_T_imu_;
      if (failed_) throw std::runtime_error(failure_);
    }
    std::this_thread::sleep_for(kLook);
  }
  throw std::runtime_error(fmt::format("[{}] gave no sample of an IMU within {:.0f} s", section_, seconds(patience)));
}

std::vector<ImuSample> ImuDriver::take()
{
  const std::lock_guard lock(mutex_);
  return std::exchange(samples_, {});
}

std::optional<std::string> ImuDriver::takeFailure()
{
  const std::lock_guard lock(mutex_);
  if (failure_.empty()) return std::nullopt;
  return std::exchange(failure_, {});
}
}  // namespace scanloom
