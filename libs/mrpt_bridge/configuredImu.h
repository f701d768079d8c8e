#pragma once
#include "config/Configuration.h"
#include "mrpt_bridge/ImuDriver.h"

#include <memory>
#include <string>

namespace scanloom
{
/**
 * Starts the sensor whose section has a `driver` and is not that of the lidars: the body's IMU. Null if there is no
 * such section. Throws ConfigError if there are several, and what ImuDriver throws.
 */
std::unique_ptr<ImuDriver> openConfiguredImu(const Configuration&, const std::string& section_of_lidars);
}  // namespace scanloom
