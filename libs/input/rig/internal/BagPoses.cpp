#include "input/rig/internal/BagPoses.h"

#include "base/core/Text.h"

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr const char* kUsualBody = "base_link";

const TopicContents* topicNamed(const std::string& name, const BagContents& bags)
{
  const auto found = std::find_if(bags.topics.begin(), bags.topics.end(),
                                  [&](const TopicContents& topic) { return topic.name == name; });
  return found == bags.topics.end() ? nullptr : &*found;
}

/** Packets of Ouster's driver name no frame: it is os_sensor, with the lidar's name before it where there are several.
 */
std::string frameOf(const FoundLidar& lidar, const BagContents& bags)
{
  const TopicContents* topic = topicNamed(lidar.topic, bags);
  if (topic && !topic->frame.empty()) return topic->frame;
  std::vector<std::string> likely;
  for (const std::string& frame : bags.frames.frames())
    if (endsWith(frame, "os_sensor")) likely.push_back(frame);
  if (likely.size() == 1) return likely.front();
  for (const std::string& frame : likely)
  {
    const std::string own = frame.substr(0, frame.size() - std::string("os_sensor").size());
    if (own.size() > 1 && lidar.topic.find("/" + own.substr(0, own.size() - 1) + "/") != std::string::npos)
      return frame;
  }
  return "";
}
}  // namespace

std::map<std::string, Rigid> posesByFrames(const BagContents& bags, const std::vector<FoundLidar>& lidars,
                                           const std::vector<std::string>& names, const std::string& imu_topic)
{
  std::map<std::string, std::string> frames;  // by the pose's name
  for (std::size_t i = 0; i < lidars.size(); ++i)
    if (!lidars[i].topic.empty()) frames["T_body_" + names[i]] = frameOf(lidars[i], bags);
  if (const TopicContents* imu = topicNamed(imu_topic, bags)) frames["T_body_imu"] = imu->frame;

  std::map<std::string, Rigid> poses;
  std::string body = bags.frames.has(kUsualBody) ? kUsualBody : "";
  for (const auto& [name, frame] : frames)
  {
    if (!bags.frames.has(frame)) continue;
    if (body.empty()) body = bags.frames.rootOf(frame);
    if (const auto body_T_frame = bags.frames.transform(body, frame)) poses[name] = *body_T_frame;
  }
  return poses;
}

std::string bodyImuTopic(const BagContents& bags, const std::vector<FoundLidar>& lidars)
{
  std::vector<TopicContents> imus = bags.ofType(&isImuType);
  const auto is_of_a_lidar = [&](const TopicContents& imu)
  {
    return std::any_of(lidars.begin(), lidars.end(),
                       [&](const FoundLidar& lidar)
                       { return !lidar.imu_topic.empty() && nameSpaceOf(lidar.topic) == nameSpaceOf(imu.name); });
  };
  imus.erase(std::remove_if(imus.begin(), imus.end(), is_of_a_lidar), imus.end());
  const auto better = [&](const TopicContents& a, const TopicContents& b)
  {
    const bool a_has = bags.frames.has(a.frame), b_has = bags.frames.has(b.frame);
    return a_has != b_has ? a_has : a.messages > b.messages;
  };
  const auto best = std::min_element(imus.begin(), imus.end(), better);
  return best == imus.end() || best->messages == 0 ? "" : best->name;
}
}  // namespace scanloom
