#pragma once
#include "site/References.h"
#include "site/internal/SiteLayout.h"

#include <vector>

namespace scanloom
{
/** Positions of the reference during the drives, at least 1 m of way apart. */
std::vector<ReferencePosition> referencePositions(const Reference&, const std::vector<SiteDrive>&, const SiteLayout&);
}  // namespace scanloom
