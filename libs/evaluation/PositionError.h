/** How far an estimated trajectory is from the true one. */
#pragma once
#include "core/StampedPose.h"

#include <cstddef>

namespace scanloom
{
struct PositionError
{
  std::size_t poses = 0;  // that were compared: those within the reference's time
  double largest = 0;     // m
  Timestamp largest_at;
  double root_mean_square = 0;  // m, the APE of evo for positions
  double final = 0;             // m, of the last pose compared
  double path_length = 0;       // m, of the reference over the same time
};

/**
 * Moves the reference so that both agree in the first pose they share (position and all of the rotation), then compares
 * positions at the estimate's stamps, the reference interpolated to them. Nothing is fitted: an error of the first
 * rotation grows with the distance. Throws std::invalid_argument if the two share no time.
 */
PositionError positionErrorFromFirstPose(const Trajectory& estimate, const Trajectory& reference);
}  // namespace scanloom
