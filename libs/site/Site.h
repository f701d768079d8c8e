/** Drives in one frame: their keyframes, joined by odometry, loops where they have seen the same place, and references.
 */
#pragma once
#include "base/core/Rigid.h"
#include "estimation/slam/PlaceSearch.h"
#include "site/References.h"
#include "site/SiteDrive.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace scanloom
{
enum class LoopDecision
{
  Accepted,
  NotFound,     // what was seen does not agree well enough
  LookAlike,    // with two places about as well
  Alone,        // no other loop beside it agrees
  Contradicts,  // the other loops, the odometry and the references
};
/** "accepted", "not found", "look alike", "alone" or "contradicts". */
std::string toString(LoopDecision);

/** A keyframe that was searched where another one is. Keyframes are numbered through all drives. */
struct Loop
{
  std::size_t from = 0, to = 0;  // `to` was searched about `from`
  double reach = 0;              // m: how far around
  double agreement = 0;          // see SearchedPlace
  LoopDecision decision = LoopDecision::NotFound;
  Rigid from_T_to{};                           // where it was found
  Matrix6d covariance = Matrix6d::Identity();  // of it, tangent of boxPlus
  double distance = 0;                         // of the solved poses from it, in standard deviations
};

struct SiteKeyframe
{
  std::size_t drive = 0, index = 0;  // which keyframe of which drive
  Rigid site_T_body;
  Matrix6d covariance = Matrix6d::Zero();  // tangent of boxPlus; of the first keyframe of a piece only its tilt
};

/** Keyframes that hang together; those of different pieces have no place in common. */
struct SitePiece
{
  std::vector<std::size_t> keyframes;  // in increasing order
  bool is_in_reference_frame = false;  // else in the frame of the drive of its first keyframe
};

struct Site
{
  std::vector<SiteKeyframe> keyframes;        // by drive, then by index
  std::vector<Loop> loops;                    // all that were searched
  std::vector<ReferencePosition> references;  // all during a drive
  std::vector<SitePiece> pieces;              // the largest first
};

/** Called with the share that is done. */
using SiteProgress = std::function<void(double share)>;

/** The same drives in the same order give the same bits. Throws std::invalid_argument without a keyframe. */
Site madeOf(const std::vector<SiteDrive>&, const SlamSettings&, const std::vector<Reference>&, const SiteProgress&);
}  // namespace scanloom
