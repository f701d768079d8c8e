/** What a simulated scene looks like, for people who want to see what they simulate. */
#pragma once
#include "simulation/Scene.h"

#include <filesystem>

namespace scanloom
{
/** As from a pole behind the machine, `t` s after the start: colours by surface. Throws what Canvas::savePng throws. */
void drawStand(const Scene&, double t, const std::filesystem::path& png);

/** One turn of every lidar from `t` s on, as it is measured: a strip each, columns by rows of beams, ranges as colours.
 */
void drawScans(const Scene&, double t, const std::filesystem::path& png);
}  // namespace scanloom
