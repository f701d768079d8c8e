#include "input/rig/Rig.h"

#include "input/rig/Extrinsics.h"
#include "input/rig/internal/BagTopics.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace scanloom
{
namespace
{
using Poses = std::map<std::string, Rigid>;

/** Throws ConfigError for a sensor that is farther from its body than the longest ship is. */
Rigid ofPlausibleSize(const std::string& key, const Rigid& pose)
{
  constexpr double kFarthest = 400;  // m
  if (const double distance = pose.translation.norm(); distance > kFarthest)
    throw ConfigError(fmt::format(
        "{}: {:.0f} m from the body's origin: in mm? Poses are x y z (m) yaw pitch roll (deg)", key, distance));
  return pose;
}

Rigid poseOf(const std::string& key, const std::string& pose, const std::string& sensor, const RigOptions& rig,
             const Poses& poses)
{
  if (!pose.empty()) try
    {
      return ofPlausibleSize(key, parsePose(pose));
    }
    catch (const std::invalid_argument& problem)
    {
      throw ConfigError(fmt::format("{} = {}: {}", key, pose, problem.what()));
    }
  const auto found = poses.find("T_body_" + sensor);
  if (found != poses.end()) return ofPlausibleSize(found->first, found->second);
  throw ConfigError(
      rig.extrinsics.empty()
          ? fmt::format("{} is missing: give [x y z yaw pitch roll] (m, deg), or 'extrinsics = FILE'", key)
          : fmt::format("{} has no T_body_{} (give it there, or as {})", rig.extrinsics, sensor, key));
}

IpAddress ipAddressOf(const std::string& key, const std::string& text)
{
  try
  {
    return IpAddress::parse(text);
  }
  catch (const std::invalid_argument& problem)
  {
    throw ConfigError(fmt::format("{}: {}", key, problem.what()));
  }
}

bool wanted(const std::string& name, const std::vector<std::string>& only)
{
  return only.empty() || std::find(only.begin(), only.end(), name) != only.end();
}

void refuseUnknownLidars(const std::vector<std::string>& only, const std::vector<LidarOptions>& lidars)
{
  std::vector<std::string> names;
  for (const LidarOptions& lidar : lidars) names.push_back(lidar.name);
  for (const std::string& name : only)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw ConfigError(fmt::format("no lidar is called '{}': {}", name, suggestion(name, names)));
}

/** One lidar without a pose, and nothing that would have a pose beside it: its frame is the body's. */
bool isWholeBody(const RigSettings& settings)
{
  return settings.lidars.size() == 1 && settings.lidars.front().pose.empty() && settings.rig.extrinsics.empty() &&
         settings.rig.imu_csv.empty() && settings.rig.imu_topic.empty();
}

/** Throws ConfigError for two IMUs, and for one without times of its samples. */
ImuOfFile bodyImuOf(const RigOptions& options, const std::vector<std::filesystem::path>& recordings)
{
  if (!options.imu_topic.empty() && !options.imu_csv.empty())
    throw ConfigError(fmt::format("imu_csv = {} and imu_topic = {}: two IMUs of the body: give one", options.imu_csv,
                                  options.imu_topic));
  ImuOfFile imu = options.imu_topic.empty() ? readImuCsv(options.imu_csv)
                                            : ImuOfFile{imuOfTopic(recordings, options.imu_topic), {}};
  const std::optional<std::string> left_out = imu.readings.leftOut();
  if (!left_out) return imu;
  const std::string said = fmt::format("{}{}: {}", options.imu_topic, options.imu_csv, *left_out);
  if (imu.readings.isStampedInBursts())
    throw ConfigError(said + ": it is stamped as it arrives, so no sample's time is known. Stamp it by its own clock");
  imu.notes.push_back(said);
  return imu;
}

LiveOptions liveOptions(const RigOptions& options)
{
  LiveOptions live;
  if (!options.bind_address.empty()) live.bind_address = ipAddressOf("bind_address", options.bind_address);
  live.receive_buffer = static_cast<std::size_t>(1e6 * options.receive_buffer);
  live.capture = options.pcap_output;
  return live;
}
}  // namespace

void refuseOneSensorTwice(const Rig& rig)
{
  for (std::size_t i = 0; i < rig.lidars.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
    {
      const BatchedLidar &one = rig.lidars[j], &other = rig.lidars[i];
      if (!one.decoder || !other.decoder) continue;
      const std::string& serial = one.decoder->description().serial;
      if (serial.empty() || serial != other.decoder->description().serial) continue;
      throw ConfigError(
          fmt::format("lidars '{}' and '{}': both have metadata of serial number {}: give each the metadata of its own "
                      "sensor",
                      one.name, other.name, serial));
    }
}

Rig makeRig(const RigSettings& settings, const std::vector<std::string>& only)
{
  refuseUnknownLidars(only, settings.lidars);
  const Poses poses = settings.rig.extrinsics.empty() ? Poses{} : readExtrinsics(settings.rig.extrinsics);

  Rig rig;
  rig.batcher = settings.batcher;
  rig.captures = capturesOf(settings.rig.pcap_input);
  rig.live = liveOptions(settings.rig);
  for (std::size_t i = 0; i < settings.lidars.size(); ++i)
  {
    const LidarOptions& options = settings.lidars[i];
    if (!wanted(options.name, only)) continue;
    RigSensor sensor;
    sensor.options = options;
    sensor.key = fmt::format("lidar{}", i + 1);
    sensor.body_T_sensor = isWholeBody(settings)
                               ? Rigid::identity()
                               : poseOf(sensor.key + "_pose", options.pose, options.name, settings.rig, poses);
    rig.sensors.push_back(std::move(sensor));
  }
  resolveTopics(rig.captures, rig.sensors);
  askForMetadata(rig.sensors, rig.captures.empty() ? MetadataNeed::OfSome : MetadataNeed::OfAll);
  for (const RigSensor& sensor : rig.sensors)
  {
    std::shared_ptr<const PacketDecoder> decoder = decoderOf(sensor);
    rig.addresses.push_back(addressOf(sensor, decoder.get()));
    rig.lidars.push_back({sensor.options.name, std::move(decoder), fromSeconds(sensor.options.time_offset)});
  }
  refuseOneSensorTwice(rig);
  if (!settings.rig.imu_csv.empty() || !settings.rig.imu_topic.empty())
  {
    rig.body_T_imu = poseOf("imu_pose", settings.rig.imu_pose, "imu", settings.rig, poses);
    ImuOfFile imu = bodyImuOf(settings.rig, rig.captures);
    rig.body_imu = std::move(imu.readings.samples);
    rig.body_imu_topic = settings.rig.imu_topic;
    rig.notes = std::move(imu.notes);
  }
  return rig;
}

Rig heardOn(std::shared_ptr<Ros2Node> node, Rig rig)
{
  for (LidarIndex i = 0; i < rig.lidars.size(); ++i)
    if (rig.addresses[i].topic.empty())
      throw ConfigError(fmt::format("lidar '{}' has no topic: name it by the key {}_topic, or leave out --ros2",
                                    rig.lidars[i].name, rig.addresses[i].key));
  if (!rig.body_imu.empty() && rig.body_imu_topic.empty())
    throw ConfigError("imu_csv is a recording: for topics that are heard live give imu_topic");
  rig.captures.clear();
  rig.body_imu.clear();
  rig.live.ros2 = std::move(node);
  return rig;
}

std::vector<RoutedLidar> routesOf(const Rig& rig)
{
  std::vector<RoutedLidar> routes;
  for (std::size_t i = 0; i < rig.lidars.size(); ++i)
    routes.push_back({rig.lidars[i].name, rig.addresses[i], rig.lidars[i].decoder.get()});
  return routes;
}
}  // namespace scanloom
