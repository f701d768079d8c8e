/** Drift: the distance from a reference, after an alignment on the start of the path. */
#pragma once
#include "base/positions/Alignment.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace scanloom
{
struct ErrorAtDistance
{
  double distance = 0;  // m, along the reference
  double error = 0;     // m, the largest of the samples there
};

struct Drift
{
  double largest = 0;  // m; this is "the drift"
  Timestamp largest_at;
  double final = 0;        // m, of the last sample
  double path_length = 0;  // m, of the reference in steps of at least 0.5 m, so that noise does not lengthen it
  std::size_t samples = 0;
  std::size_t fitted = 0;  // number of samples in the first 10 % of the path, which the alignment used
  Alignment alignment;
  std::vector<ErrorAtDistance> over_distance;  // per step of the path: its samples are those up to the next step

  /** The drift in percent of the path; none if the machine stood still. */
  std::optional<double> percent() const;
};

/** Aligns on the samples in the first 10 % of the path, and compares all. Throws std::invalid_argument without pairs.
 */
Drift driftOf(const std::vector<PositionPair>&, AlignmentKind);
}  // namespace scanloom
