#include "mrpt/sensors/ImuDriverInput.h"

#include "mrpt/sensors/ImuDriver.h"

#include <algorithm>
#include <utility>

namespace scanloom
{
namespace
{
constexpr Duration kFirstSample = 10s;  // how long the driver may take for it
constexpr Duration kBetweenLooks = 5ms;
}  // namespace

ImuDriverInput::ImuDriverInput(std::unique_ptr<SensorInput> lidars, std::unique_ptr<ImuDriver> imu)
  : lidars_(std::move(lidars)), imu_(std::move(imu)), body_T_imu_(imu_->body_T_imu(kFirstSample))
{
}

ImuDriverInput::~ImuDriverInput() = default;

std::optional<SensorEvent> ImuDriverInput::next(Duration patience)
{
  if (samples_.empty())
    for (const ImuSample& sample : imu_->take()) samples_.push_back(sample);
  if (samples_.empty()) return lidars_->next(std::min(patience, kBetweenLooks));
  const SensorImu event{SensorImu::kBody, samples_.front()};
  samples_.pop_front();
  return event;
}

SensorSetup ImuDriverInput::setup() const
{
  SensorSetup setup = lidars_->setup();
  setup.body_T_imu[SensorImu::kBody] = body_T_imu_;
  return setup;
}

std::vector<std::string> ImuDriverInput::takeWarnings()
{
  std::vector<std::string> warnings = lidars_->takeWarnings();
  if (const auto failure = imu_->takeFailure()) warnings.push_back(*failure);
  return warnings;
}
}  // namespace scanloom
