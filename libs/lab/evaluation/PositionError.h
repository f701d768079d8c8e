/** The position error of a trajectory whose first pose is taken as true. */
#pragma once
#include "base/core/StampedPose.h"

#include <cstddef>

namespace scanloom
{
struct PositionError
{
  std::size_t poses = 0;  // number of poses that were compared: those within the time of the reference
  double largest = 0;     // m
  Timestamp largest_at;
  double root_mean_square = 0;  // m, the APE of evo for positions
  double final = 0;             // m, of the last pose compared
  double path_length = 0;       // m, of the reference over the same time
  double covered = 0;           // share of the reference's time at which there is an estimate
};

/**
 * Moves the reference so that the first common poses are equal (position and rotation), interpolates it to the
 * estimate's stamps, and compares positions. There is no fit: an error of the first rotation grows with the distance.
 * Throws std::invalid_argument if the two have no time in common.
 */
PositionError positionErrorFromFirstPose(const Trajectory& estimate, const Trajectory& reference);
}  // namespace scanloom
