#pragma once
#include "estimation/ndt/CellCorrections.h"

namespace scanloom
{
/**
 * For stands of trees: points of stems and poles are moved onto their axes (correctNearSideBias), and the means of
 * foliage to where they were if points did not get fewer with the range (rangeDensityShift).
 */
CellCorrections forestCorrections();

/** Those of stands, or none. */
CellCorrections cellCorrections(bool in_forest);
}  // namespace scanloom
