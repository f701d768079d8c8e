#include "support/SceneInput.h"

#include "input/rig/Extrinsics.h"
#include "input/rig/internal/RigStream.h"
#include "lab/simulation/internal/ScenePackets.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>

namespace scanloom
{
namespace
{
/** So far ahead of the packets the body's IMU is: nothing that a packet completes may lack a sample. */
constexpr Duration kImuAhead = 1s;

class SceneInput : public SensorInput
{
 public:
  SceneInput(std::shared_ptr<const Scene> scene, const Rig& rig)
    : setup_(setupOf(rig)),
      scene_(std::move(scene)),
      packets_(*scene_),
      imu_(scene_->scenery.drive(), scene_->span, scene_->body_imu, scene_->seed),
      stream_(rig, RigStream::ReceiveTimes::OfCapture)
  {
  }

  using SensorInput::next;
  std::optional<SensorEvent> next(Duration) override
  {
    std::optional<SensorEvent> event = stream_.next();
    while (!event && !read_)
    {
      if (!stop_ && packets_.next(datagram_))
        take();
      else
      {
        if (!stop_) takeImuBefore(scene_->span.end());
        read_ = true;
        stream_.finish();
      }
      event = stream_.next();
    }
    ended_ = !event;
    return event;
  }

  bool ended() const override { return ended_; }
  void stop() override { stop_ = true; }
  SensorSetup setup() const override { return setup_; }
  double progress() const override { return packets_.share(); }
  std::vector<std::string> takeWarnings() override { return stream_.takeWarnings(); }

  RigAccount account() const override
  {
    RigAccount account = stream_.account();
    account.input["datagrams"] = datagrams_;
    return account;
  }

 private:
  void take()
  {
    takeImuBefore(datagram_.received + kImuAhead);
    stream_.take(datagram_);
    ++datagrams_;
  }

  void takeImuBefore(Timestamp until)
  {
    std::vector<ImuSample> samples;
    for (const ImuStream::Sample& sample : imu_.before(until)) samples.push_back(sample.reading);
    stream_.takeBodyImu(samples);
  }

  SensorSetup setup_;
  std::shared_ptr<const Scene> scene_;
  ScenePackets packets_;
  ImuStream imu_;
  RigStream stream_;
  Datagram datagram_;
  std::uint64_t datagrams_ = 0;
  std::atomic<bool> stop_{false};
  bool read_ = false;
  bool ended_ = false;
};

/** What a pose is after it was written and read. */
Rigid asWritten(const Rigid& pose) { return parsePose(poseText(pose)); }
}  // namespace

Rig rigOf(const Scene& scene, const BatcherOptions& batcher, const std::vector<std::string>& only)
{
  for (const std::string& name : only)
    if (std::none_of(scene.lidars.begin(), scene.lidars.end(), [&](const auto& lidar) { return lidar.name == name; }))
      throw std::invalid_argument(fmt::format("no simulated lidar is called '{}'", name));

  Rig rig;
  rig.batcher = batcher;
  for (const LidarStation& lidar : scene.lidars)
  {
    if (!only.empty() && std::find(only.begin(), only.end(), lidar.name) == only.end()) continue;
    RigSensor sensor;
    sensor.options.name = lidar.name;
    sensor.body_T_sensor = asWritten(lidar.written_body_T_sensor);
    sensor.metadata = LidarMetadata{toJson(lidar.metadata()), lidar.name};
    std::shared_ptr<const PacketDecoder> decoder = decoderOf(sensor);
    rig.addresses.push_back(addressOf(sensor, decoder.get()));
    rig.lidars.push_back({lidar.name, std::move(decoder), Duration{0}});
    rig.sensors.push_back(std::move(sensor));
  }
  rig.body_T_imu = asWritten(scene.body_imu.body_T_imu);
  return rig;
}

std::unique_ptr<SensorInput> makeSceneInput(std::shared_ptr<const Scene> scene, const Rig& rig)
{
  return std::make_unique<SceneInput>(std::move(scene), rig);
}
}  // namespace scanloom
