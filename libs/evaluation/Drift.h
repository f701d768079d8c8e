/** How far an estimate runs away from a reference that it agreed with at the start. */
#pragma once
#include "evaluation/Alignment.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace scanloom
{
struct ErrorAtDistance
{
  double distance = 0;  // m, along the reference
  double error = 0;     // m, the largest there
};

struct Drift
{
  double largest = 0;  // m: "the drift"
  Timestamp largest_at;
  double final = 0;        // m, of the last sample
  double path_length = 0;  // m, of the reference: its polyline in steps of at least 0.5 m, so that noise adds nothing
  std::size_t samples = 0;
  std::size_t fitted = 0;  // of them, those up to 10 % of the path, on which the alignment rests
  Alignment alignment;
  std::vector<ErrorAtDistance> over_distance;  // per vertex of the polyline, which gets the samples up to the next one

  /** Of the path; nothing if the machine stood still. */
  std::optional<double> percent() const;
};

/** Aligned on all samples up to 10 % of the path, then compared in all. Throws std::invalid_argument without pairs. */
Drift driftOf(const std::vector<PositionPair>&, AlignmentKind);
}  // namespace scanloom
