#include "run/run/GivenMap.h"

#include "base/core/Angle.h"
#include "base/core/ConfigError.h"
#include "base/formats/Trajectory.h"
#include "mrpt/maps/SimpleMapReader.h"

#include <fmt/format.h>

#include <array>
#include <sstream>

namespace scanloom
{
namespace
{
std::shared_ptr<const PriorMap> readKeyframes(const std::filesystem::path& folder, const SlamSettings& settings)
{
  const SimpleMapReader reader(keyframesOf(folder));
  std::vector<Keyframe> keyframes;
  std::vector<Matrix6d> covariances;
  for (std::size_t i = 0; i < reader.size(); ++i)
  {
    keyframes.push_back(reader.keyframe(i));
    covariances.push_back(reader.covariance(i));
  }
  return std::make_shared<const PriorMap>(keyframes, reader.lidars(), settings, covariances);
}

Rigid lastPoseOf(const std::filesystem::path& file)
{
  const Trajectory poses = readTum(file);
  if (poses.empty()) throw UsageError(fmt::format("--at {}: has no pose", file.string()));
  return poses.back().map_T_body;
}

Rigid poseFrom(const std::string& text)
{
  std::istringstream stream(text);
  std::array<double, 6> v{};
  for (double& value : v) stream >> value;
  std::string rest;
  if (stream.fail() || stream >> rest)
    throw UsageError(fmt::format("--at '{}': must be \"x y z yaw pitch roll\" (m, deg) or a .tum file", text));
  return Rigid::fromXyzYawPitchRoll(v[0], v[1], v[2], v[3] * kDegree, v[4] * kDegree, v[5] * kDegree);
}
}  // namespace

std::filesystem::path keyframesOf(const std::filesystem::path& folder)
{
  std::filesystem::path file = folder / "keyframes.simplemap";
  if (!std::filesystem::exists(file))
    throw UsageError(
        fmt::format("{} has no keyframes.simplemap: --map takes a result folder of `scanloom slam`, run with maps "
                    "(output.maps = true)",
                    folder.string()));
  return file;
}

GivenMap readGivenMap(const std::filesystem::path& folder, const std::string& at, const SlamSettings& settings)
{
  std::optional<Rigid> map_T_body;
  if (std::filesystem::path(at).extension() == ".tum")
    map_T_body = lastPoseOf(at);
  else if (!at.empty())
    map_T_body = poseFrom(at);
  return {readKeyframes(folder, settings), map_T_body};
}
}  // namespace scanloom
