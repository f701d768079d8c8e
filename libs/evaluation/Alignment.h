/** The frame in which an estimate is compared with a reference: nothing ties the two but positions at the same times.
 */
#pragma once
#include "core/Rigid.h"
#include "evaluation/PositionTrack.h"

#include <vector>

namespace scanloom
{
enum class AlignmentKind
{
  Yaw,  // rotation about z and translation: both frames know where down is
  Se3   // all of the rotation, and translation: as evo's --align (Umeyama 1991, without scale)
};

struct Alignment
{
  Rigid reference_T_map;

  /**
   * Root mean square distance of the samples from the axis about which they fix the rotation worst, in m: position
   * noise of s tilts the frame by s / (lever sqrt(samples)) rad.
   */
  double lever = 0;

  /** How much better, in variance, the best fixed axis is than the worst. 1 for yaw, infinite on a straight line. */
  double condition = 1;
};

/** Least squares of the distances. Throws std::invalid_argument without pairs. */
Alignment align(const std::vector<PositionPair>&, AlignmentKind);
}  // namespace scanloom
