#include "SlamInput.h"

#include "Devices.h"
#include "base/core/ConfigError.h"
#include "base/core/Progress.h"
#include "input/rig/RigOptions.h"
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
}  // namespace

SlamInput openForSlam(const InputSource& source, const Configuration& configuration)
{
  SlamInput input{openInput(source), megabytesOf(source.rig.captures), source.isLive()};
  if (!input.live) return input;
  if (const std::optional<std::string> imu = imuSection(configuration, rigSection(configuration)))
    input.sensors = devices().addImu(std::move(input.sensors), configuration, *imu);
  return input;
}

void refuseUnknownImu(const SensorInput& input, const SlamOptions& options)
{
  chosenImu(input, options.imu, fromSeconds(1e-3 * options.imu_delay_ms));
}
}  // namespace scanloom
