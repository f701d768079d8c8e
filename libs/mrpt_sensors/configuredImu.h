#pragma once
#include "config/Configuration.h"
#include "mrpt_sensors/ImuDriver.h"

#include <memory>
#include <string>

namespace scanloom
{
/** Starts the sensor that the section describes. Throws what ImuDriver throws. */
std::unique_ptr<ImuDriver> openConfiguredImu(const Configuration&, const std::string& section);
}  // namespace scanloom
