/** Settings of `slam` for the simulated harvester, whose own points are cropped. */
#pragma once
#include "base/config/Configuration.h"
#include "estimation/slam/internal/SlamSettings.h"

namespace scanloom
{
inline SlamSettings harvesterSettings()
{
  SlamSettings settings;
  settings.crop = Configuration::fromFiles({SCANLOOM_SOURCE_DIR "/params/harvester.ini"}).read<CropOptions>("crop");
  return settings;
}
}  // namespace scanloom
