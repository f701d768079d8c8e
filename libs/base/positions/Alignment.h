/** Aligns the frame of an estimate (map) with that of a reference, from positions of one point at the same times. */
#pragma once
#include "base/core/Rigid.h"
#include "base/positions/PositionTrack.h"

#include <vector>

namespace scanloom
{
enum class AlignmentKind
{
  Yaw,  // rotation about z, and translation: z is vertical in both frames
  Se3   // rotation and translation, as evo's --align (Umeyama 1991, without scale)
};

struct Alignment
{
  Rigid reference_T_map;

  /**
   * Root mean square distance, in m, of the samples from the axis of the least certain rotation. With a position noise
   * of s the standard deviation of that rotation is s / (lever sqrt(samples)) rad.
   */
  double lever = 0;

  /** Variance of the least certain rotation over that of the most certain one. 1 for yaw, infinite on a straight line.
   */
  double condition = 1;
};

/** Minimises the squared distances. Throws std::invalid_argument if there are no pairs. */
Alignment align(const std::vector<PositionPair>&, AlignmentKind);
}  // namespace scanloom
