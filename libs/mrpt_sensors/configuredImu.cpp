#include "mrpt_sensors/configuredImu.h"

#include <mrpt/config/CConfigFileMemory.h>

namespace scanloom
{
std::unique_ptr<ImuDriver> openConfiguredImu(const Configuration& configuration, const std::string& section)
{
  mrpt::config::CConfigFileMemory as_mrpt;
  for (const std::string& key : configuration.keys(section))
    as_mrpt.write(section, key, configuration.text(section, key));
  return std::make_unique<ImuDriver>(as_mrpt, section);
}
}  // namespace scanloom
