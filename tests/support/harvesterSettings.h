/** Settings of `slam` for the simulated harvester, whose own points are cropped. */
#pragma once
#include "config/Configuration.h"
#include "slam/SlamSettings.h"

namespace scanloom
{
inline SlamSettings harvesterSettings()
{
  SlamSettings settings;
  settings.crop = Configuration::fromFiles({SCANLOOM_SOURCE_DIR "/params/simulated_rig.ini"}).read<CropOptions>("crop");
  return settings;
}
}  // namespace scanloom
