#include "input/rig/RecognisedRig.h"

#include "base/config/iniValue.h"
#include "base/core/ConfigError.h"
#include "base/core/NewFile.h"
#include "base/core/Text.h"
#include "input/rig/Extrinsics.h"
#include "input/rig/RigOptions.h"
#include "input/rig/internal/BagPoses.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>

namespace scanloom
{
namespace
{
using Paths = RecordingFiles::Paths;
using Poses = std::map<std::string, Rigid>;

constexpr const char* kUnknownPose = "[0 0 0 0 0 0]";

constexpr Duration kBagLookedAt = 10s;  // of a bag: its static transforms and metadata come first

// Parts of the names of message types that hold what lidars and IMUs measure.
constexpr std::array kMeasuredTypes{"PointCloud", "Imu", "Scan", "Packet", "CustomMsg"};

/** The parts of a topic's name before its last one: "left", "ouster" of "/left/ouster/lidar_packets". */
std::vector<std::string> nameSpacesOf(const std::string& topic)
{
  std::vector<std::string> parts;
  std::istringstream names(topic.substr(0, topic.rfind('/') + 1));
  for (std::string part; std::getline(names, part, '/');)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

/** The first part of the topic's name that not all topics share; of one topic alone the first. */
std::string nameByTopic(const std::string& topic, const std::vector<FoundLidar>& lidars)
{
  if (topic.find('/') == std::string::npos) return topic;  // the label of a rawlog
  const std::vector<std::string> parts = nameSpacesOf(topic);
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (lidars.size() == 1 || std::any_of(lidars.begin(), lidars.end(),
                                          [&](const FoundLidar& other)
                                          {
                                            const auto others = nameSpacesOf(other.topic);
                                            return i >= others.size() || others[i] != parts[i];
                                          }))
      return parts[i];
  return "";
}

std::string nameOf(const FoundLidar& lidar, const std::vector<FoundLidar>& lidars)
{
  if (!lidar.topic.empty()) return nameByTopic(lidar.topic, lidars);
  return lidar.metadata.has_extension() ? lidar.metadata.stem().string() : "";
}

/** The metadata file's name, of a bag a part of the topic's name, unless two lidars would share it. */
std::vector<std::string> namesOf(const std::vector<FoundLidar>& lidars)
{
  std::map<std::string, int> uses;
  for (const FoundLidar& lidar : lidars) ++uses[printable(nameOf(lidar, lidars))];
  std::vector<std::string> names;
  for (const FoundLidar& lidar : lidars)
  {
    const std::string name = printable(nameOf(lidar, lidars));
    names.push_back(!name.empty() && uses[name] == 1 ? name : fmt::format("lidar{}", names.size() + 1));
  }
  return names;
}

std::string onlyOne(const Paths& files, const char* what)
{
  if (files.size() > 1)
    throw UsageError(
        fmt::format("{} and {}: two files {}: name the right one", files[0].string(), files[1].string(), what));
  return files.empty() ? "" : files.front().string();
}

bool isReceived(const FoundLidar& lidar) { return !lidar.topic.empty() || lidar.source != IpAddress{}; }

std::string describe(const LidarDescription& lidar)
{
  return fmt::format("{}{}{}, {} columns at {:g} Hz", lidar.model, lidar.serial.empty() ? "" : " ", lidar.serial,
                     lidar.columns_per_frame, lidar.frame_rate);
}

class Ini
{
 public:
  explicit Ini(const std::filesystem::path& folder) : folder_(std::filesystem::absolute(folder).lexically_normal()) {}
  /** The blank behind a `\` keeps it from joining the next line. */
  void comment(const std::string& text)
  {
    text_ += fmt::format("// {}{}\n", text, text.empty() || text.back() != '\\' ? "" : " ");
  }
  void set(const std::string& key, const std::string& value)
  {
    text_ += fmt::format("{:<16} = {}\n", key, iniValue(value));
  }
  void leave(const std::string& key, const std::string& value, const std::string& why)
  {
    text_ += fmt::format("// FILL IN: {}\n//{:<14} = {}\n", why, key, iniValue(value));
  }
  std::string text() const { return text_; }

  /** A file as it is named from the INI's folder; what is no file, as a model or a topic, stays as it is. */
  std::string from(const std::filesystem::path& file) const
  {
    if (file.is_absolute() || !isTaken(file)) return file.string();
    return std::filesystem::absolute(file).lexically_proximate(folder_).string();
  }
  std::string from(const Paths& files) const
  {
    std::vector<std::string> names;
    for (const auto& file : files) names.push_back(from(file));
    return fmt::format("{}", fmt::join(names, ", "));
  }

 private:
  std::filesystem::path folder_;
  std::string text_ = "[lidars]\ndriver           = CMultiLidarSensor\nprocess_rate     = 100\n";
};

void addLidar(const FoundLidar& lidar, const std::string& key, const std::string& name, Ini& ini)
{
  ini.comment(describe(lidar.description));
  ini.set(key + "_name", name);
  ini.set(key + "_metadata", ini.from(lidar.metadata));
  if (!lidar.topic.empty())
  {
    ini.set(key + "_topic", lidar.topic);
    if (!lidar.imu_topic.empty()) ini.set(key + "_imu_topic", lidar.imu_topic);
    return;
  }
  if (lidar.port != 0) ini.set(key + "_port", std::to_string(lidar.port));
  if (lidar.imu_port != 0) ini.set(key + "_imu_port", std::to_string(lidar.imu_port));
  if (lidar.source_matters && lidar.source != IpAddress{}) ini.set(key + "_address", lidar.source.text());
}

/** One lidar alone is the body's frame; of several it must be known how they stand to each other. */
void addPose(const std::string& key, const std::string& name, const Poses& poses, std::size_t lidars,
             RecognisedRig& rig, Ini& ini)
{
  if (const auto known = poses.find("T_body_" + name); known != poses.end())
  {
    if (rig.poses_from_bag) ini.set(key + "_pose", fmt::format("[{}]", poseText(known->second)));
    return;
  }
  if (lidars == 1 && poses.empty()) return ini.comment("a lidar alone needs no pose: its frame is the body's");
  ini.leave(key + "_pose", kUnknownPose, "the lidar's pose in the body frame, x y z (m) yaw pitch roll (deg)");
  rig.unknown_poses.push_back(key + "_pose");
  rig.notes.push_back(
      fmt::format("the pose of lidar '{}' in the body frame is not known: give {}_pose = [x y z yaw pitch "
                  "roll] (m, deg), or an extrinsics file with a line T_body_{}",
                  name, key, name));
}

/** Of poses that are not known: which names there are, and who finds the poses. */
void addWaysOut(const std::string& extrinsics, const Poses& poses, std::size_t lidars, RecognisedRig& rig)
{
  if (rig.unknown_poses.empty()) return;
  std::vector<std::string> names;
  for (const auto& [name, pose] : poses) names.push_back(name);
  if (!extrinsics.empty())
    rig.notes.push_back(fmt::format("{} has {}: name the lidars so (lidar1_name), or their metadata files", extrinsics,
                                    fmt::join(names, ", ")));
  if (lidars > 1)
    rig.notes.push_back("'scanloom calibrate' with this recording finds how the lidars stand to each other");
}

/** `key` says where the samples are: imu_csv or imu_topic. */
void addImu(const std::string& key, const std::string& imu, const Poses& poses, RecognisedRig& rig, Ini& ini)
{
  if (imu.empty()) return;
  const std::string value = ini.from(imu);
  if (const auto pose = poses.find("T_body_imu"); pose != poses.end())
  {
    ini.set(key, value);
    if (rig.poses_from_bag) ini.set("imu_pose", fmt::format("[{}]", poseText(pose->second)));
    rig.found.push_back(fmt::format("IMU of the body: {}", imu));
    return;
  }
  ini.leave(key, value, "imu_pose, the IMU's pose in the body frame, x y z (m) yaw pitch roll (deg)");
  rig.lost.push_back(
      fmt::format("{} is not used: its pose in the body frame is not known (imu_pose, or T_body_imu in an "
                  "extrinsics file)",
                  imu));
  rig.notes.push_back(rig.lost.back());
}

/** So that one scan is one turn, where all lidars turn alike; with one lidar, from the recording's first column on. */
void addScanTimes(const std::vector<FoundLidar>& lidars, Ini& ini)
{
  const FoundLidar& first = lidars.front();
  const double rate = first.description.frame_rate;
  if (!std::all_of(lidars.begin(), lidars.end(),
                   [&](const FoundLidar& lidar) { return lidar.description.frame_rate == rate; }))
    return;
  ini.set("scan_rate", fmt::format("{:g}", rate));
  if (lidars.size() > 1 || !first.first_stamp) return;
  const Duration phase = first.first_stamp->time_since_epoch() % fromSeconds(1 / rate);
  ini.comment("scans begin with the first column of this recording");
  ini.set("scan_phase_ms", fmt::format("{:.6f}", 1e3 * seconds(phase)));
}

/**
 * Sensors that sent nothing. One whose pose is given belongs to the rig: the run says at its end that it is missing.
 * Other files may lie in the folder for other recordings; where only clouds were recorded, all sensors are silent.
 */
void addUnheard(LidarsFound& found, const Poses& poses)
{
  const auto isCloud = [](const FoundLidar& lidar)
  { return !lidar.topic.empty() && topicNamedBy(lidar.metadata.string()) == lidar.topic; };
  const bool clouds = std::any_of(found.lidars.begin(), found.lidars.end(), isCloud);
  std::vector<std::string> others;
  for (const MetadataCandidate& silent : found.unheard)
  {
    const bool is_topic = topicNamedBy(silent.file.string()).has_value();
    const std::string described = fmt::format("{} ({})", silent.file.string(), describe(silent.decoder->description()));
    if (!is_topic && poses.count("T_body_" + silent.file.stem().string()) > 0)
    {
      FoundLidar lidar;
      lidar.metadata = silent.file;
      lidar.description = silent.decoder->description();
      lidar.port = lidar.description.lidar_port;
      found.lidars.push_back(lidar);
      found.notes.push_back(fmt::format("no packet is of {}", described));
    }
    else if (!is_topic || !clouds)
      others.push_back(described);
  }
  markSharedPorts(found.lidars);
  constexpr std::size_t kMostNamed = 3;
  const std::string more =
      others.size() > kMostNamed ? fmt::format(" and {} more", others.size() - kMostNamed) : std::string();
  others.resize(std::min(others.size(), kMostNamed));
  if (!others.empty()) found.notes.push_back(fmt::format("no packet is of {}{}", fmt::join(others, ", "), more));
}

/** A lidar is lost by it if its pose is given, or if packets are of no other metadata. */
void addFaulty(const LidarsFound& found, const Poses& poses, RecognisedRig& rig)
{
  for (const MetadataCandidate& candidate : found.faulty)
  {
    rig.notes.push_back("not used: " + candidate.fault);
    if (found.left_streams_out || poses.count("T_body_" + candidate.file.stem().string()) > 0)
      rig.lost.push_back(rig.notes.back());
  }
}

/** Topics that hold what a lidar or an IMU measured, and that no sensor of the rig is on. */
void addUnusedTopics(const BagContents& bags, const LidarsFound& found, const std::string& imu_topic,
                     RecognisedRig& rig)
{
  std::set<std::string> known{imu_topic};
  for (const FoundLidar& lidar : found.lidars) known.insert({lidar.topic, lidar.imu_topic});
  for (const auto* candidates : {&found.unheard, &found.faulty})
    for (const MetadataCandidate& candidate : *candidates)
      if (const auto topic = topicNamedBy(candidate.file.string())) known.insert(*topic);
  const auto isMeasured = [](const std::string& type)
  {
    return std::any_of(kMeasuredTypes.begin(), kMeasuredTypes.end(),
                       [&](const char* part) { return type.find(part) != std::string::npos; });
  };
  for (const TopicContents& topic : bags.topics)
    if (topic.messages > 0 && isMeasured(topic.type) && known.count(topic.name) == 0)
      rig.notes.push_back(printable(fmt::format("not used: topic {} ({}){}{}", topic.name, topic.type,
                                                topic.note.empty() ? "" : ": ", topic.note)));
}

/** A bag whose topics are of other kinds should at least tell them. */
LidarsFound foundIn(const Paths& captures, std::vector<MetadataCandidate> candidates, const BagContents& bags)
try
{
  return findLidars(streamsOf(captures), std::move(candidates), captures);
}
catch (const UsageError& none)
{
  if (bags.topics.empty()) throw;
  std::string message = none.what();
  for (const TopicContents& topic : bags.topics)
    message += "\n  " + printable(fmt::format("topic {} ({}) {}", topic.name, topic.type, topic.note));
  throw UsageError(message);
}
}  // namespace

RecognisedRig recogniseRig(const RecordingFiles& files, const std::filesystem::path& ini_folder)
{
  const std::string extrinsics = onlyOne(files.extrinsics, "of poses");
  const std::string imu = onlyOne(files.imus, "of IMU samples");
  const BagContents bags = contentsOf(files.captures, kBagLookedAt);
  std::vector<MetadataCandidate> candidates = candidatesFrom(files.metadata);
  for (MetadataCandidate& candidate : candidatesFrom(bags.metadata)) candidates.push_back(std::move(candidate));
  LidarsFound found = foundIn(files.captures, std::move(candidates), bags);
  const Poses of_file = extrinsics.empty() ? Poses{} : readExtrinsics(extrinsics);
  addUnheard(found, of_file);
  const std::vector<std::string> names = namesOf(found.lidars);
  const std::string imu_topic = imu.empty() ? bodyImuTopic(bags, found.lidars) : "";

  RecognisedRig rig;
  rig.notes = found.notes;
  addFaulty(found, of_file, rig);
  for (const TopicContents& topic : bags.topics)
    if (topic.one_instant)
      rig.notes.push_back(printable(
          fmt::format("topic {}: all points of a cloud have one time, so the motion within a turn cannot be corrected",
                      topic.name)));
  rig.poses_from_bag = extrinsics.empty();
  const Poses poses = rig.poses_from_bag ? posesByFrames(bags, found.lidars, names, imu_topic) : of_file;
  Ini ini(ini_folder);
  ini.set("pcap_input", ini.from(files.captures));
  if (!extrinsics.empty()) ini.set("extrinsics", ini.from(extrinsics));
  for (std::size_t i = 0; i < found.lidars.size(); ++i)
  {
    const FoundLidar& lidar = found.lidars[i];
    const std::string key = fmt::format("lidar{}", i + 1);
    addLidar(lidar, key, names[i], ini);
    addPose(key, names[i], poses, found.lidars.size(), rig, ini);
    if (!isReceived(lidar)) continue;
    const std::string place = lidar.topic.empty() ? fmt::format("from {} to port {}", lidar.source.text(), lidar.port)
                                                  : "on topic " + lidar.topic;
    rig.found.push_back(
        fmt::format("lidar '{}': {}, {}, {}", names[i], describe(lidar.description), place, lidar.metadata.string()));
  }
  addWaysOut(extrinsics, poses, found.lidars.size(), rig);
  rig.poses_known = !poses.empty() && rig.unknown_poses.empty();
  addImu("imu_csv", imu, poses, rig, ini);
  addImu("imu_topic", imu_topic, poses, rig, ini);
  addUnusedTopics(bags, found, imu_topic, rig);
  addScanTimes(found.lidars, ini);
  if (std::any_of(found.lidars.begin(), found.lidars.end(),
                  [](const FoundLidar& lidar) { return !lidar.topic.empty(); }))
  {
    ini.comment("messages arrive less evenly than datagrams, and are held back longer than this anyway");
    ini.set("deadline_ms", "100");
  }
  rig.ini = ini.text();
  return rig;
}
}  // namespace scanloom
