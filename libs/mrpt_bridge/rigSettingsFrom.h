#pragma once
#include "source/RigOptions.h"

#include <mrpt/config/CConfigFileBase.h>

#include <string>

namespace scanloom
{
/**
 * The settings of a sensor section as an MRPT application holds it: variables expanded, comments gone, places of keys
 * forgotten. Throws ConfigError with all that is wrong, by section and key.
 */
RigSettings rigSettingsFrom(const mrpt::config::CConfigFileBase&, const std::string& section);
}  // namespace scanloom
