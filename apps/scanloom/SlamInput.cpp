#include "SlamInput.h"

#include "Devices.h"
#include "base/core/ConfigError.h"
#include "base/core/Progress.h"
#include "input/rig/CloudsInput.h"
#include "input/rig/ReadAhead.h"
#include "input/rig/Rig.h"
#include "input/rig/RigOptions.h"
#include "input/rig/openRig.h"
#include "mrpt/observations/RawlogInput.h"
#include "run/run/ImuInUse.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
/**
 * The section that has a `driver` and is not that of the lidars: the body's IMU. Throws ConfigError if there are
 * several.
 */
std::optional<std::string> imuSection(const Configuration& configuration, const std::string& section_of_lidars)
{
  std::vector<std::string> found;
  for (const std::string& section : configuration.sections())
    if (configuration.isSensor(section) && section != section_of_lidars) found.push_back(section);
  if (found.size() > 1)
    throw ConfigError(fmt::format(
        "sections [{}] and [{}] both have a driver: only one, the IMU, can be beside the lidars", found[0], found[1]));
  return found.empty() ? std::nullopt : std::optional(found.front());
}

SlamInput openLive(const Rig& rig, const Configuration& configuration, const std::string& section)
{
  std::unique_ptr<SensorInput> sensors = openRig(rig);
  if (const std::optional<std::string> imu = imuSection(configuration, section))
    sensors = devices().addImu(std::move(sensors), configuration, *imu);
  return {std::move(sensors), 0, true};
}

std::unique_ptr<SensorInput> readAhead(std::unique_ptr<SensorInput> input)
{
  return std::make_unique<ReadAhead>(std::move(input));
}
}  // namespace

SlamInput openInput(const RecordingFiles& files, const std::vector<std::string>& lidars,
                    const Configuration& configuration, Duration body_imu_ahead)
{
  if (!files.rawlogs.empty()) return {readAhead(std::make_unique<RawlogInput>(files.rawlogs.front(), lidars))};
  if (!files.clouds.empty())
  {
    if (!lidars.empty()) throw UsageError("clouds do not tell lidars apart: all lidars are used");
    return {readAhead(std::make_unique<CloudsInput>(files.clouds))};
  }
  const std::string section = rigSection(configuration);
  Rig rig = makeRig(readRigSettings(configuration, section), lidars);
  rig.body_imu_ahead = body_imu_ahead;
  if (rig.captures.empty()) return openLive(rig, configuration, section);
  const std::uint64_t megabytes = megabytesOf(rig.captures);
  return {readAhead(openRig(rig)), megabytes};
}

void refuseUnknownImu(const SlamInput& input, const SlamOptions& options)
{
  chosenImu(*input.sensors, options.imu, fromSeconds(1e-3 * options.imu_delay_ms));
}
}  // namespace scanloom
