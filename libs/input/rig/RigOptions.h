/** The INI section of a sensor rig: the same keys for `scanloom` and for the plugin in MRPT's stock applications. */
#pragma once
#include "base/config/Configuration.h"
#include "base/core/Field.h"
#include "input/batching/TimeBatcher.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scanloom
{
/** The captures of `pcap_input`. */
std::vector<std::filesystem::path> capturesOf(const std::string& list);

/** PathsFrom of `pcap_input`. */
std::string capturePathsFrom(const std::string& list, const std::filesystem::path& folder);

/** What `metadata` begins with if it names a topic of a bag: "topic:/left/metadata". */
inline constexpr std::string_view kTopicPrefix = "topic:";

/** The name behind the prefix; none if it has none. */
std::optional<std::string> topicNamedBy(const std::string& metadata);

/** PathsFrom of `metadata`: a topic is no path, nor is a built-in model's name, unless there is a file of that name. */
std::string metadataPathFrom(const std::string& file_or_model, const std::filesystem::path& folder);

/** One lidar. Its keys have the prefix lidar1_, lidar2_, ...; it exists if metadata or address is given. */
struct LidarOptions
{
  std::string name;
  std::string metadata;
  std::string pose;
  std::string address;
  std::string topic;
  std::string imu_topic;
  int port = 0;
  int imu_port = 0;
  double time_offset = 0;
  bool configure_sensor = false;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.name, Field{"name", "", "the lidar's name in all outputs; empty: lidar1, lidar2, ..."});
    visit(o.metadata,
          Field{"metadata", "",
                "the sensor's metadata, a JSON file, a model's name (VLP-16, XT32 dual) or 'topic:NAME' of a bag; "
                "empty: the sensor at 'address' is asked for them",
                unbounded(), metadataPathFrom});
    visit(o.pose,
          Field{"pose", "m, deg",
                "pose of the sensor in the body frame, [x y z yaw pitch roll]; empty: from extrinsics; without those a "
                "single lidar's frame is the body's"});
    visit(o.address, Field{"address", "",
                           "the sensor's IP address, or address:port of its web page: only packets from there are this "
                           "lidar's; it is asked for metadata if no file is given"});
    visit(o.topic, Field{"topic", "", "bag: topic of its packets; empty: the only one that holds packets"});
    visit(o.imu_topic, Field{"imu_topic", "", "bag: topic of its IMU packets; empty: none"});
    visit(o.port, Field{"port", "", "UDP port of its lidar packets; 0: from the metadata", between(0, 65535)});
    visit(o.imu_port, Field{"imu_port", "", "UDP port of its IMU packets; 0: from the metadata", between(0, 65535)});
    visit(o.time_offset, Field{"time_offset", "s", "added to the stamps of its packets", between(-1e6, 1e6)});
    visit(o.configure_sensor, Field{"configure_sensor", "",
                                    "true: a sensor asked for metadata is set to send its packets to this computer"});
  }
};

struct RigOptions
{
  std::string pcap_input;
  std::string pcap_output;
  std::string bind_address;
  double receive_buffer = 16;
  std::string extrinsics;
  std::string imu_csv;
  std::string imu_topic;
  std::string imu_pose;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.pcap_input,
          Field{"pcap_input", "", "captures and bags to read, separated by commas, merged by record time; empty: live",
                unbounded(), capturePathsFrom});
    visit(o.pcap_output,
          Field{"pcap_output", "", "live: pcap file that all received packets are written to; empty: none", unbounded(),
                pathFrom});
    visit(o.bind_address, Field{"bind_address", "",
                                "live: receive on this address of the computer, or join this multicast group; empty: "
                                "receive on all"});
    visit(o.receive_buffer,
          Field{"receive_buffer", "MB", "live: size of the kernel's receive buffer per port", between(0.01, 1000)});
    visit(o.extrinsics, Field{"extrinsics", "", "file of lines 'T_body_<name> x y z yaw pitch roll' (m, deg)",
                              unbounded(), pathFrom});
    visit(o.imu_csv, Field{"imu_csv", "",
                           "the body's own IMU, as csv: EuRoC's columns, or those that a heading names; empty: none",
                           unbounded(), pathFrom});
    visit(o.imu_topic, Field{"imu_topic", "", "the body's own IMU, a topic of a bag; empty: none"});
    visit(o.imu_pose,
          Field{"imu_pose", "m, deg",
                "pose of the IMU in the body frame, [x y z yaw pitch roll]; empty: T_body_imu of extrinsics"});
  }
};

/** Keys that MRPT's applications read from every sensor section; process_rate is mandatory there. */
struct DriverOptions
{
  std::string driver = "CMultiLidarSensor";
  std::string sensorLabel = "lidar";
  std::string cloud_class = "CGenericPointsMap";
  double process_rate = 100;
  int grab_decimation = 0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.driver, Field{"driver", "", "the sensor's class, by which MRPT finds it"});
    visit(o.sensorLabel, Field{"sensorLabel", "", "label of the clouds"});
    visit(o.cloud_class,
          Field{"cloud_class", "",
                "CGenericPointsMap (all fields) or CPointsMapXYZI (stock 2.x tools without the plugin)"});
    visit(o.process_rate, Field{"process_rate", "Hz", "how often rawlog-grabber reads the sensor", above(0)});
    visit(o.grab_decimation,
          Field{"grab_decimation", "", "rawlog-grabber keeps every n-th observation; 0: all", atLeast(0)});
  }
};

/** All keys of the section. */
struct RigSettings
{
  DriverOptions driver;
  RigOptions rig;
  BatcherOptions batcher;
  std::vector<LidarOptions> lidars;  // lidar1_, lidar2_, ... up to the last that has metadata or an address

  /** Without the lidars, which are a list. */
  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    DriverOptions::fields(o.driver, visit);
    RigOptions::fields(o.rig, visit);
    BatcherOptions::fields(o.batcher, visit);
  }
};

/** Every key of such a section, with lidar1_ for all lidars: for manuals and default files. */
Schema rigSchema(const std::string& section);

/** The one section with driver = CMultiLidarSensor. Throws ConfigError if there is none or more than one. */
std::string rigSection(const Configuration&);

bool hasRigSection(const Configuration&);

/** Relative paths of every such section start at the folder of the file that they stand in. */
void makeRigPathsAbsolute(Configuration&);

/** Throws ConfigError with all problems, unknown keys among them. */
RigSettings readRigSettings(const Configuration&, const std::string& section);
}  // namespace scanloom
