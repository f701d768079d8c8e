#include "input/rig/RigOptions.h"

#include "base/core/NewFile.h"
#include "base/core/Text.h"
#include "input/lidar/BuiltInModels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace scanloom
{
namespace
{
std::vector<std::string> sectionsOfRigs(const Configuration& configuration)
{
  std::vector<std::string> found;
  for (const std::string& section : configuration.sections())
    if (configuration.has(section, "driver") && configuration.text(section, "driver") == DriverOptions{}.driver)
      found.push_back(section);
  return found;
}
}  // namespace

std::vector<std::filesystem::path> capturesOf(const std::string& list)
{
  std::vector<std::filesystem::path> paths;
  for (std::size_t at = 0; at < list.size();)
  {
    const std::size_t comma = std::min(list.find(',', at), list.size());
    const std::string_view path = trimmed(std::string_view(list).substr(at, comma - at));
    if (!path.empty()) paths.emplace_back(path);
    at = comma + 1;
  }
  return paths;
}

std::string capturePathsFrom(const std::string& list, const std::filesystem::path& folder)
{
  std::vector<std::string> paths;
  for (const auto& path : capturesOf(list)) paths.push_back(pathFrom(path.string(), folder));
  return fmt::format("{}", fmt::join(paths, ", "));
}

std::optional<std::string> topicNamedBy(const std::string& metadata)
{
  if (metadata.compare(0, kTopicPrefix.size(), kTopicPrefix) != 0) return std::nullopt;
  return metadata.substr(kTopicPrefix.size());
}

std::string metadataPathFrom(const std::string& file_or_model, const std::filesystem::path& folder)
{
  if (topicNamedBy(file_or_model)) return file_or_model;
  std::string path = pathFrom(file_or_model, folder);
  return builtInMetadata(file_or_model) && !isTaken(path) ? file_or_model : path;
}

Schema rigSchema(const std::string& section)
{
  Schema schema;
  const std::string meaning = "the lidars, their packets and how they become scans";
  merge(schema, describe<RigSettings>({section, meaning}));
  merge(schema, describe({section, meaning, "lidar"}, std::vector<LidarOptions>(1)));
  return schema;
}

bool hasRigSection(const Configuration& configuration) { return !sectionsOfRigs(configuration).empty(); }

void makeRigPathsAbsolute(Configuration& configuration)
{
  for (const std::string& section : sectionsOfRigs(configuration))
    configuration.makePathsAbsolute(rigSchema(section).front());
}

std::string rigSection(const Configuration& configuration)
{
  const std::vector<std::string> found = sectionsOfRigs(configuration);
  if (found.empty())
    throw ConfigError("no section with 'driver = CMultiLidarSensor': the lidars to be read are not configured");
  if (found.size() > 1)
    throw ConfigError(fmt::format(
        "sections [{}] and [{}] both have 'driver = CMultiLidarSensor': put all lidars into one", found[0], found[1]));
  return found.front();
}

RigSettings readRigSettings(const Configuration& configuration, const std::string& section)
{
  auto settings = configuration.read<RigSettings>(section);
  const auto exists = [&](std::size_t i)
  {
    return configuration.has(section, numbered("lidar", i) + "metadata") ||
           configuration.has(section, numbered("lidar", i) + "address");
  };
  while (exists(settings.lidars.size())) settings.lidars.emplace_back();

  std::vector<std::string> problems = configuration.unknownKeys(section, rigSchema(section).front());
  if (settings.lidars.empty())
    problems.push_back(
        fmt::format("[{}] neither lidar1_metadata nor lidar1_address is given: no lidar is configured", section));
  else
    collect(problems,
            [&] {
              settings.lidars =
                  configuration.readList(section, settings.lidars, "lidar", "lidarN_metadata or lidarN_address");
            });
  refuse(problems);

  for (std::size_t i = 0; i < settings.lidars.size(); ++i)
    if (settings.lidars[i].name.empty()) settings.lidars[i].name = fmt::format("lidar{}", i + 1);
  for (std::size_t i = 0; i < settings.lidars.size(); ++i)
    if (settings.lidars[i].metadata.empty() && settings.lidars[i].address.empty())
      problems.push_back(fmt::format("[{0}] {1}metadata and {1}address are empty: give a file, or the sensor's address",
                                     section, numbered("lidar", i)));
  for (std::size_t i = 0; i < settings.lidars.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (sameName(settings.lidars[i].name, settings.lidars[j].name))
        problems.push_back(
            configuration
                .invalidValue(section, numbered("lidar", i) + "name", "must differ from the other lidars' names")
                .what());
  refuse(problems);
  return settings;
}
}  // namespace scanloom
