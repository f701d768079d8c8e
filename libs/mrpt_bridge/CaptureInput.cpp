#include <fmt/format.h>

#include "mrpt_bridge/RigObservations.h"
#include "mrpt_bridge/SensorInput.h"
#include "source/RigReplay.h"

namespace scanloom
{
namespace
{
class CaptureInput : public SensorInput
{
 public:
  explicit CaptureInput(Rig rig) : rig_(std::move(rig)), header_(recordingHeader(rig_)), replay_(rig_) {}

  std::optional<SensorEvent> next() override { return replay_.next(); }
  const RecordingHeader& header() const override { return header_; }
  double progress() const override { return replay_.progress(); }
  std::map<std::string, std::uint64_t> counts() const override { return countsOf(replay_.account()); }

  std::optional<Rigid> body_T_imu(int sensor) const override
  {
    if (sensor == SensorImu::kBody)
      return rig_.body_imu.empty() ? std::optional<Rigid>() : std::optional<Rigid>(rig_.body_T_imu);
    const LidarDescription& lidar = rig_.lidars.at(static_cast<std::size_t>(sensor)).decoder->description();
    return lidar.body_T_sensor * lidar.sensor_T_imu;
  }

  std::vector<std::string> takeWarnings() override { return replay_.takeWarnings(); }

 private:
  Rig rig_;
  RecordingHeader header_;
  RigReplay replay_;
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

std::unique_ptr<SensorInput> makeCaptureInput(Rig rig) { return std::make_unique<CaptureInput>(std::move(rig)); }
}  // namespace scanloom
