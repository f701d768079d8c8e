#include "source/RigOptions.h"

#include <fmt/format.h>

#include <algorithm>

namespace scanloom
{
namespace
{
std::string prefixOf(std::size_t lidar) { return fmt::format("lidar{}_", lidar + 1); }

bool sameName(std::string_view a, std::string_view b) { return editDistance(a, b) == 0; }

std::vector<std::string> unknownKeys(const Configuration& configuration, const std::string& section, std::size_t lidars)
{
  std::vector<std::string> known;
  for (const SectionDescription& part : rigSchema(section))
    for (const FieldDescription& field : part.fields) known.push_back(field.field.name);
  for (std::size_t i = 1; i < lidars; ++i)
    for (const FieldDescription& field : describe<LidarOptions>({section, "", prefixOf(i)}).fields)
      known.push_back(field.field.name);

  std::vector<std::string> problems;
  for (const std::string& key : configuration.keys(section))
    if (std::none_of(known.begin(), known.end(), [&key](const auto& name) { return sameName(name, key); }))
      problems.push_back(fmt::format("{}: [{}] unknown key '{}': {}", toString(configuration.place(section, key)),
                                     section, key, suggestion(key, known)));
  return problems;
}

std::vector<std::string> sectionsOfRigs(const Configuration& configuration)
{
  std::vector<std::string> found;
  for (const std::string& section : configuration.sections())
    if (configuration.has(section, "driver") && configuration.text(section, "driver") == DriverOptions{}.driver)
      found.push_back(section);
  return found;
}
}  // namespace

Schema rigSchema(const std::string& section)
{
  Schema schema;
  const std::string meaning = "the lidars, their packets and how they become scans";
  merge(schema, describe<DriverOptions>({section, meaning}));
  merge(schema, describe<RigOptions>({section, meaning}));
  merge(schema, describe<BatcherOptions>({section, meaning}));
  merge(schema, describe({section, meaning, "lidar"}, std::vector<LidarOptions>(1)));
  return schema;
}

bool hasRigSection(const Configuration& configuration) { return !sectionsOfRigs(configuration).empty(); }

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
  RigSettings settings;
  settings.driver = configuration.read<DriverOptions>(section);
  settings.rig = configuration.read<RigOptions>(section);
  settings.batcher = configuration.read<BatcherOptions>(section);
  const auto exists = [&](std::size_t i) {
    return configuration.has(section, prefixOf(i) + "metadata") || configuration.has(section, prefixOf(i) + "address");
  };
  for (std::size_t i = 0; exists(i); ++i)
  {
    settings.lidars.push_back(configuration.read<LidarOptions>(section, {}, prefixOf(i)));
    if (settings.lidars.back().name.empty()) settings.lidars.back().name = fmt::format("lidar{}", i + 1);
  }

  std::vector<std::string> problems = unknownKeys(configuration, section, settings.lidars.size());
  if (settings.lidars.empty())
    problems.push_back(
        fmt::format("[{}] neither lidar1_metadata nor lidar1_address is given: no lidar is configured", section));
  for (std::size_t i = 0; i < settings.lidars.size(); ++i)
    if (settings.lidars[i].metadata.empty() && settings.lidars[i].address.empty())
      problems.push_back(fmt::format("[{0}] {1}metadata and {1}address are empty: give a file, or the sensor's address",
                                     section, prefixOf(i)));
  for (std::size_t i = 0; i < settings.lidars.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (sameName(settings.lidars[i].name, settings.lidars[j].name))
        problems.push_back(
            configuration.complaint(section, prefixOf(i) + "name", "must differ from the other lidars' names").what());
  if (!problems.empty()) throw ConfigError(problems);
  return settings;
}
}  // namespace scanloom
