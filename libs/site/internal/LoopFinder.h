/** Which keyframes are searched about which others, and which of the places found are believed. */
#pragma once
#include "site/Site.h"
#include "site/internal/SiteLayout.h"

#include <functional>
#include <vector>

namespace scanloom
{
class LoopSearch;

/** A keyframe whose pose in the frame of its piece is known otherwise than by a loop or its odometry. */
struct KnownKeyframe
{
  std::size_t keyframe;
  double sigma;  // m
};

/** What is known of a site while its loops are searched. */
struct SiteState
{
  std::vector<SiteKeyframe> keyframes;
  std::vector<Loop> loops;
  std::vector<KnownKeyframe> known;
};

/**
 * The loops with those that were found in addition: keyframes of the part `of` about earlier ones of the part `about`,
 * both in one frame. A keyframe is searched where the nearest loop, known keyframe or its odometry has it, as far
 * around as that may be off, about one keyframe of each pass by the place. `searching` is called before each.
 */
std::vector<Loop> withLoopsFound(const SiteState&, const SiteLayout&, const LoopSearch&, std::size_t of,
                                 std::size_t about, const std::function<void(std::size_t keyframe)>& searching);

/** Loops that no other one beside them confirms become Alone: the odometry must lead from one to the other. */
std::vector<Loop> withoutLoneOnes(std::vector<Loop>, const std::vector<SiteKeyframe>&, const SiteLayout&);
}  // namespace scanloom
