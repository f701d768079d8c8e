#pragma once
#include "input/rig/RigOptions.h"

#include <mrpt/config/CConfigFileBase.h>

#include <string>

namespace scanloom
{
/**
 * The settings of a sensor section that an MRPT application has read: variables are expanded, and lines are not known
 * any more. Throws ConfigError with all problems, by section and key.
 */
RigSettings rigSettingsFrom(const mrpt::config::CConfigFileBase&, const std::string& section);
}  // namespace scanloom
