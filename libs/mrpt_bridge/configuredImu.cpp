#include "mrpt_bridge/configuredImu.h"

#include "core/ConfigError.h"

#include <fmt/format.h>
#include <mrpt/config/CConfigFileMemory.h>

#include <vector>

namespace scanloom
{
std::unique_ptr<ImuDriver> openConfiguredImu(const Configuration& configuration, const std::string& section_of_lidars)
{
  std::vector<std::string> found;
  for (const std::string& section : configuration.sections())
    if (configuration.isSensor(section) && section != section_of_lidars) found.push_back(section);
  if (found.empty()) return nullptr;
  if (found.size() > 1)
    throw ConfigError(fmt::format(
        "sections [{}] and [{}] both have a driver: only one, the IMU, can be beside the lidars", found[0], found[1]));

  mrpt::config::CConfigFileMemory as_mrpt;
  for (const std::string& key : configuration.keys(found.front()))
    as_mrpt.write(found.front(), key, configuration.text(found.front(), key));
  return std::make_unique<ImuDriver>(as_mrpt, found.front());
}
}  // namespace scanloom
