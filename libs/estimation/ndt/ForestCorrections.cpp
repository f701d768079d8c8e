#include "estimation/ndt/ForestCorrections.h"

#include "estimation/ndt/internal/RangeDensityBias.h"
#include "estimation/ndt/internal/StemAxisCorrection.h"

namespace scanloom
{
CellCorrections forestCorrections() { return {&correctNearSideBias, &rangeDensityShift}; }

CellCorrections cellCorrections(bool in_forest) { return in_forest ? forestCorrections() : CellCorrections{}; }
}  // namespace scanloom
