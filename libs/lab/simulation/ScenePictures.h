/** Pictures of a simulated scene. */
#pragma once
#include "lab/simulation/internal/Scene.h"

#include <filesystem>

namespace scanloom
{
/** The stand seen from above and behind the machine, `t` s after the start; a colour per kind of surface. Throws as
 * Canvas::savePng. */
void drawStand(const Scene&, double t, const std::filesystem::path& png);

/** The first turn of every lidar from `t` s on as a range image: columns by beams, ranges as colours. */
void drawScans(const Scene&, double t, const std::filesystem::path& png);
}  // namespace scanloom
