#include <fmt/format.h>

#include "mrpt_bridge/RigObservations.h"
#include "mrpt_bridge/SensorInput.h"
#include "source/RigReplay.h"

namespace scanloom
{
namespace
{
class RigSensorInput : public SensorInput
{
 public:
  RigSensorInput(const Rig& rig, std::unique_ptr<RigInput> input, bool has_body_imu)
    : lidars_(rig.lidars), header_(recordingHeader(rig)), input_(std::move(input))
  {
    if (has_body_imu) body_T_imu_ = rig.body_T_imu;
  }

  std::optional<SensorEvent> next() override { return input_->next(); }
  const RecordingHeader& header() const override { return header_; }
  double progress() const override { return input_->progress(); }
  std::map<std::string, std::uint64_t> counts() const override { return countsOf(input_->account()); }

  std::optional<Rigid> body_T_imu(int sensor) const override
  {
    if (sensor == SensorImu::kBody) return body_T_imu_;
    const LidarDescription& lidar = lidars_.at(static_cast<std::size_t>(sensor)).decoder->description();
    return lidar.body_T_sensor * lidar.sensor_T_imu;
  }

  std::vector<std::string> takeWarnings() override { return input_->takeWarnings(); }

 private:
  std::vector<BatchedLidar> lidars_;
  RecordingHeader header_;
  std::optional<Rigid> body_T_imu_;
  std::unique_ptr<RigInput> input_;
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
  return std::make_unique<RigSensorInput>(rig, std::move(input), has_body_imu);
}

std::unique_ptr<SensorInput> makeCaptureInput(const Rig& rig)
{
  return makeRigSensorInput(rig, std::make_unique<RigReplay>(rig), !rig.body_imu.empty());
}
}  // namespace scanloom
