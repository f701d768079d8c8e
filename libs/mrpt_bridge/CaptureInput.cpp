#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "mrpt_bridge/ImuDriver.h"
#include "mrpt_bridge/RigObservations.h"
#include "mrpt_bridge/SensorInput.h"
#include "source/RigReplay.h"

namespace scanloom
{
namespace
{
constexpr Duration kLookForSamples = 5ms;

class RigSensorInput : public SensorInput
{
 public:
  RigSensorInput(const Rig& rig, std::unique_ptr<RigInput> input, std::optional<Rigid> body_T_imu,
                 std::unique_ptr<ImuDriver> imu = nullptr)
    : lidars_(rig.lidars),
      header_(recordingHeader(rig)),
      body_T_imu_(body_T_imu),
      input_(std::move(input)),
      imu_(std::move(imu))
  {
  }

  std::optional<SensorEvent> next(Duration patience) override
  {
    if (imu_ && samples_.empty())
      for (const ImuSample& sample : imu_->take()) samples_.push_back(sample);
    if (samples_.empty()) return input_->next(imu_ ? std::min(patience, kLookForSamples) : patience);
    const SensorImu event{SensorImu::kBody, samples_.front()};
    samples_.pop_front();
    return event;
  }

  bool ended() const override { return input_->ended(); }
  const RecordingHeader& header() const override { return header_; }
  double progress() const override { return input_->progress(); }
  std::map<std::string, std::uint64_t> counts() const override { return countsOf(input_->account()); }

  std::optional<Rigid> body_T_imu(int sensor) const override
  {
    if (sensor == SensorImu::kBody) return body_T_imu_;
    const auto& decoder = lidars_.at(static_cast<std::size_t>(sensor)).decoder;
    if (!decoder) return std::nullopt;  // live: not known yet
    const LidarDescription& lidar = decoder->description();
    return lidar.body_T_sensor * lidar.sensor_T_imu;
  }

  std::vector<std::string> takeWarnings() override
  {
    std::vector<std::string> warnings = input_->takeWarnings();
    if (imu_)
      if (const auto failure = imu_->takeFailure()) warnings.push_back(*failure);
    return warnings;
  }

 private:
  std::vector<BatchedLidar> lidars_;
  RecordingHeader header_;
  std::optional<Rigid> body_T_imu_;
  std::unique_ptr<RigInput> input_;
  std::unique_ptr<ImuDriver> imu_;  // none: its samples come with the input, or there are none
  std::deque<ImuSample> samples_;   // taken from it
};
}  // namespace

std::map<std::string, std::uint64_t> countsOf(const RigAccount& account)
{
  std::map<std::string, std::uint64_t> counts = account.input;
  for (const LidarAccount& lidar : account.lidars)
    forEachCount(lidar.counters, [&](const char* fate, std::uint64_t count)
                 { counts[fmt::format("{}.{}", lidar.name, fate)] = count; });
  std::uint64_t strangers = 0;
  for (const auto& [origin, datagrams] : account.unmatched) strangers += datagrams;
  counts["datagrams_of_no_lidar"] = strangers;
  counts["imu_samples_late"] = account.late_imu_samples;
  return counts;
}

std::unique_ptr<SensorInput> makeRigSensorInput(const Rig& rig, std::unique_ptr<RigInput> input, bool has_body_imu)
{
  return std::make_unique<RigSensorInput>(rig, std::move(input),
                                          has_body_imu ? std::optional(rig.body_T_imu) : std::nullopt);
}

std::unique_ptr<SensorInput> makeRigSensorInput(const Rig& rig, std::unique_ptr<RigInput> input,
                                                std::unique_ptr<ImuDriver> imu)
{
  constexpr Duration kPatience = 10s;
  const Rigid body_T_imu = imu->body_T_imu(kPatience);
  return std::make_unique<RigSensorInput>(rig, std::move(input), body_T_imu, std::move(imu));
}

std::unique_ptr<SensorInput> makeCaptureInput(const Rig& rig)
{
  return makeRigSensorInput(rig, std::make_unique<RigReplay>(rig), !rig.body_imu.empty());
}
}  // namespace scanloom
