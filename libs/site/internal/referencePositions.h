#pragma once
#include "site/References.h"
#include "site/internal/SiteLayout.h"

#include <vector>

namespace scanloom
{
/** Positions of the reference during the drives, so far apart that they do not err alike. */
std::vector<ReferencePosition> referencePositions(const Reference&, const std::vector<SiteDrive>&, const SiteLayout&);
}  // namespace scanloom
