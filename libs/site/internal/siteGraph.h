/** The pose graph of a piece of a site. */
#pragma once
#include "site/References.h"
#include "site/Site.h"
#include "site/internal/SiteLayout.h"

#include <vector>

namespace scanloom
{
/** What holds the keyframes of a site. */
struct SiteMeasurements
{
  std::vector<SiteKeyframe> keyframes;
  std::vector<Loop> loops;
  std::vector<ReferencePosition> references;
};

/**
 * The piece of these keyframes, in increasing order, by odometry, gravity, accepted loops, and positions that are not
 * refused yet: in the frame of the references, or in that of its first keyframe if there are none. Loops and positions
 * that contradict the others are refused.
 */
SiteMeasurements solvedPiece(SiteMeasurements, const std::vector<std::size_t>& piece, const std::vector<SiteDrive>&,
                             const SiteLayout&);

/** The keyframes of a solved piece with their covariances. */
std::vector<SiteKeyframe> withCovariances(const SiteMeasurements&, const std::vector<std::size_t>& piece,
                                          const std::vector<SiteDrive>&, const SiteLayout&);
}  // namespace scanloom
