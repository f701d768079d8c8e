#include "input/rig/RecordingHeader.h"

#include "input/rig/Rig.h"

namespace scanloom
{
namespace
{
RecordedLidar recordedLidar(const std::string& name, const LidarDescription& lidar)
{
  return {name, lidar.serial, lidar.model, lidar.body_T_sensor, lidar.channels, lidar.columns_per_frame, lidar.clock};
}
}  // namespace

RecordingHeader recordingHeader(const Rig& rig)
{
  RecordingHeader header;
  header.scan_rate = rig.batcher.scan_rate;
  for (LidarIndex i = 0; i < rig.lidars.size(); ++i)
  {
    LidarDescription description;
    if (const std::shared_ptr<const PacketDecoder>& decoder = rig.lidars[i].decoder)
      description = decoder->description();
    else
      description.body_T_sensor = rig.sensors.at(i).body_T_sensor;  // live: its sensor has not answered yet
    header.lidars.push_back(recordedLidar(rig.lidars[i].name, description));
  }
  return header;
}

std::vector<MountedLidar> mountedLidars(const std::vector<RecordedLidar>& recorded)
{
  std::vector<MountedLidar> lidars;
  for (const RecordedLidar& lidar : recorded) lidars.push_back({lidar.name, lidar.body_T_sensor});
  return lidars;
}

std::vector<std::string> lidarNames(const RecordingHeader& header)
{
  std::vector<std::string> names;
  for (const RecordedLidar& lidar : header.lidars) names.push_back(lidar.name);
  return names;
}
}  // namespace scanloom
