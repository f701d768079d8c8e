#include "lab/study/RunReference.h"

#include "base/formats/TrajectoryReader.h"
#include "base/positions/TotalStation.h"
#include "input/rig/Extrinsics.h"
#include "input/rig/FileKind.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace scanloom
{
namespace
{
using Paths = std::vector<std::filesystem::path>;

Paths filesBeside(const std::filesystem::path& recording)
{
  const auto folder = std::filesystem::is_directory(recording) ? recording : recording.parent_path();
  Paths files;
  for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/** Two of the same name (total_station.csv, total_station.tsv) would leave to chance what is compared. */
std::optional<std::filesystem::path> onlyOne(const Paths& files, const std::string& name)
{
  std::optional<std::filesystem::path> found;
  for (const auto& file : files)
  {
    if (file.stem() != name) continue;
    if (found)
      throw std::invalid_argument(fmt::format("{} and {}: two references; name one in [experiment] references",
                                              found->string(), file.string()));
    found = file;
  }
  return found;
}

bool isExtrinsics(const std::filesystem::path& file)
try
{
  return kindOf(file) == FileKind::Extrinsics;
}
catch (const std::exception&)
{
  return false;  // whatever else a person put there
}

std::optional<Eigen::Vector3d> prismIn(const Paths& files)
{
  for (const auto& file : files)
  {
    if (!isExtrinsics(file)) continue;
    const auto poses = readExtrinsics(file);
    if (const auto prism = poses.find("T_body_prism"); prism != poses.end()) return prism->second.translation;
  }
  return std::nullopt;
}

void addStation(const std::filesystem::path& file, const Paths& beside, RunReference& reference)
{
  reference.station = readTotalStation(file);
  const auto prism = prismIn(beside);
  if (prism) reference.body_p_point = *prism;
  reference.description =
      fmt::format("{} at {}", file.filename().string(),
                  prism ? "the prism" : "the body's origin, since no extrinsics file has T_body_prism");
}

void addPoses(const std::filesystem::path& file, RunReference& reference)
{
  const auto describe = [&](const std::string& text)
  { reference.description += fmt::format("{}{}", reference.description.empty() ? "" : ", ", text); };
  describe(file.filename().string());
  reference.poses = readTrajectory(file, describe);
}
}  // namespace

RunReference referenceOf(const std::filesystem::path& recording, const std::filesystem::path& given)
{
  RunReference reference;
  if (given == kNoReference) return reference;
  const Paths beside = filesBeside(recording);
  const bool look = given.empty();
  const auto station = look                    ? onlyOne(beside, "total_station")
                       : isTotalStation(given) ? std::optional(given)
                                               : std::nullopt;
  const auto poses = look ? onlyOne(beside, "groundtruth") : station ? std::nullopt : std::optional(given);
  if (station) addStation(*station, beside, reference);
  if (poses) addPoses(*poses, reference);
  return reference;
}
}  // namespace scanloom
