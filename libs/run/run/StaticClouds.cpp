#include "run/run/StaticClouds.h"

#include "base/formats/CloudFile.h"
#include "input/rig/Extrinsics.h"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

namespace scanloom
{
namespace
{
/** Also of left.pcd.gz. */
std::string lidarOf(const std::filesystem::path& cloud)
{
  const std::filesystem::path name = cloud.extension() == ".gz" ? cloud.stem() : cloud.filename();
  return name.stem().string();
}

std::map<std::string, Rigid> posesIn(const std::vector<std::filesystem::path>& files)
{
  std::map<std::string, Rigid> poses;
  for (const std::filesystem::path& file : files) poses.merge(readExtrinsics(file));
  return poses;
}
}  // namespace

StaticClouds readStaticClouds(const std::vector<std::filesystem::path>& clouds,
                              const std::vector<std::filesystem::path>& extrinsics)
{
  const std::map<std::string, Rigid> poses = posesIn(extrinsics);
  StaticClouds all;
  all.poses = extrinsics.empty() ? PoseGiven::No : PoseGiven::Within20Degrees;
  for (const std::filesystem::path& cloud : clouds)
  {
    const std::string name = lidarOf(cloud);
    for (const MountedLidar& other : all.lidars)
      if (other.name == name)
        throw std::runtime_error(fmt::format("{}: another cloud is called '{}', too", cloud.string(), name));
    const auto pose = poses.find("T_body_" + name);
    if (!extrinsics.empty() && pose == poses.end())
      throw std::runtime_error(
          fmt::format("{} has no T_body_{}, the pose of {}", extrinsics.front().string(), name, cloud.string()));
    all.lidars.push_back({name, pose == poses.end() ? Rigid::identity() : pose->second});
    all.points.push_back({readCloud(cloud).points, all.lidars.back().body_T_sensor});
  }
  return all;
}
}  // namespace scanloom
