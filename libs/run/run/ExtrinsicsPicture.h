/** A picture of how a calibration moved a lidar: a stem and the ground, seen by two lidars, before and after. */
#pragma once
#include "calibration/ExtrinsicsScene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
struct ExtrinsicsPictureText
{
  std::string reference, lidar;
};

/**
 * A PNG of four panels, before above after: from above what stands out most between 1.0 and 1.6 m above the ground, a
 * stem or a post, in a window of 1.6 m; and a strip of ground, 10 m long and 0.6 m wide, from the side, as heights
 * above the plane through the reference's points there. Both are chosen among all scenes by the points after
 * calibration; a panel says so if there is nothing that both lidars see. Throws std::runtime_error if the file cannot
 * be written.
 */
void drawExtrinsics(const std::filesystem::path&, const std::vector<ExtrinsicsScene>&, const ExtrinsicsPictureText&);
}  // namespace scanloom
