#include "recordings/RecognisedRig.h"

#include "core/ConfigError.h"
#include "recordings/FoundLidars.h"
#include "rig/Extrinsics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace scanloom
{
namespace
{
using Paths = RecordingFiles::Paths;
using Poses = std::map<std::string, Rigid>;

constexpr const char* kUnknownPose = "[0 0 0 0 0 0]";

/** The file's name, unless two lidars would share it, or it is a model's. */
std::vector<std::string> namesOf(const std::vector<FoundLidar>& lidars)
{
  std::map<std::string, int> uses;
  for (const FoundLidar& lidar : lidars) ++uses[lidar.metadata.stem().string()];
  std::vector<std::string> names;
  for (const FoundLidar& lidar : lidars)
  {
    const std::string name = lidar.metadata.stem().string();
    const bool is_file = lidar.metadata.has_extension();
    names.push_back(is_file && uses[name] == 1 ? name : fmt::format("lidar{}", names.size() + 1));
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

std::string listOf(const Paths& paths)
{
  std::vector<std::string> names;
  for (const auto& path : paths) names.push_back(path.string());
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string describe(const LidarDescription& lidar)
{
  return fmt::format("{} {}, {} columns at {:g} Hz", lidar.model, lidar.serial, lidar.columns_per_frame,
                     lidar.frame_rate);
}

class Ini
{
 public:
  void comment(const std::string& text) { text_ += fmt::format("// {}\n", text); }
  void set(const std::string& key, const std::string& value) { text_ += fmt::format("{:<16} = {}\n", key, value); }
  void leave(const std::string& key, const std::string& value, const std::string& why)
  {
    text_ += fmt::format("// FILL IN: {}\n//{:<14} = {}\n", why, key, value);
  }
  std::string text() const { return text_; }

 private:
  std::string text_ = "[lidars]\ndriver           = CMultiLidarSensor\nprocess_rate     = 100\n";
};

void addLidar(const FoundLidar& lidar, const std::string& key, const std::string& name, Ini& ini)
{
  ini.comment(describe(lidar.description));
  ini.set(key + "_name", name);
  ini.set(key + "_metadata", lidar.metadata.string());
  ini.set(key + "_port", std::to_string(lidar.port));
  if (lidar.imu_port != 0) ini.set(key + "_imu_port", std::to_string(lidar.imu_port));
  if (lidar.source_matters) ini.set(key + "_address", lidar.source.text());
}

/** One lidar alone is the body's frame; of several it must be known how they stand to each other. */
void addPose(const std::string& key, const std::string& name, const Poses& poses, std::size_t lidars,
             RecognisedRig& rig, Ini& ini)
{
  if (poses.count("T_body_" + name) > 0) return;
  if (lidars == 1 && poses.empty()) return ini.comment("a lidar alone needs no pose: its frame is the body's");
  ini.leave(key + "_pose", kUnknownPose, "the lidar's pose in the body frame, x y z (m) yaw pitch roll (deg)");
  rig.unknown_poses.push_back(key + "_pose");
  rig.notes.push_back(
      fmt::format("the pose of lidar '{}' in the body frame is not known: give {}_pose = [x y z yaw pitch "
                  "roll] (m, deg), or an extrinsics file with a line T_body_{}",
                  name, key, name));
}

void addImu(const std::string& imu, const Poses& poses, RecognisedRig& rig, Ini& ini)
{
  if (imu.empty()) return;
  if (poses.count("T_body_imu") > 0)
  {
    ini.set("imu_csv", imu);
    rig.found.push_back(fmt::format("IMU of the body: {}", imu));
    return;
  }
  ini.leave("imu_csv", imu, "imu_pose, the IMU's pose in the body frame, x y z (m) yaw pitch roll (deg)");
  rig.notes.push_back(
      fmt::format("{} is not used: its pose in the body frame is not known (imu_pose, or T_body_imu in an "
                  "extrinsics file)",
                  imu));
}

/** So that one scan is one turn, where all lidars turn alike. */
void addScanRate(const std::vector<FoundLidar>& lidars, Ini& ini)
{
  const double rate = lidars.front().description.frame_rate;
  if (std::all_of(lidars.begin(), lidars.end(),
                  [&](const FoundLidar& lidar) { return lidar.description.frame_rate == rate; }))
    ini.set("scan_rate", fmt::format("{:g}", rate));
}
}  // namespace

RecognisedRig recogniseRig(const RecordingFiles& files)
{
  const std::string extrinsics = onlyOne(files.extrinsics, "of poses");
  const std::string imu = onlyOne(files.imus, "of IMU samples");
  const Poses poses = extrinsics.empty() ? Poses{} : readExtrinsics(extrinsics);
  const LidarsFound found = findLidars(streamsOf(files.captures), candidatesFrom(files.metadata), files.captures);
  const std::vector<std::string> names = namesOf(found.lidars);

  RecognisedRig rig;
  rig.notes = found.notes;
  Ini ini;
  ini.set("pcap_input", listOf(files.captures));
  if (!extrinsics.empty()) ini.set("extrinsics", extrinsics);
  for (std::size_t i = 0; i < found.lidars.size(); ++i)
  {
    const FoundLidar& lidar = found.lidars[i];
    const std::string key = fmt::format("lidar{}", i + 1);
    addLidar(lidar, key, names[i], ini);
    addPose(key, names[i], poses, found.lidars.size(), rig, ini);
    rig.found.push_back(fmt::format("lidar '{}': {}, from {} to port {}, {}", names[i], describe(lidar.description),
                                    lidar.source.text(), lidar.port, lidar.metadata.string()));
  }
  rig.poses_known = !poses.empty() && rig.unknown_poses.empty();
  addImu(imu, poses, rig, ini);
  addScanRate(found.lidars, ini);
  rig.ini = ini.text();
  return rig;
}
}  // namespace scanloom
