#pragma once
#include "input/rig/SensorInput.h"

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
class ImuDriver;

/** The events of live lidars, and among them the samples of the body's IMU from a driver of its own. */
class ImuDriverInput : public SensorInput
{
 public:
  /** Waits for the driver's first sample, which gives the IMU's pose; throws what ImuDriver::body_T_imu() throws. */
  ImuDriverInput(std::unique_ptr<SensorInput> lidars, std::unique_ptr<ImuDriver>);
  ~ImuDriverInput() override;

  using SensorInput::next;
  std::optional<SensorEvent> next(Duration patience) override;
  bool ended() const override { return lidars_->ended(); }
  void stop() override { lidars_->stop(); }
  SensorSetup setup() const override;
  RigAccount account() const override { return lidars_->account(); }
  std::vector<std::string> takeWarnings() override;

 private:
  std::unique_ptr<SensorInput> lidars_;
  std::unique_ptr<ImuDriver> imu_;
  Rigid body_T_imu_;
  std::deque<ImuSample> samples_;  // taken from the driver
};
}  // namespace scanloom
