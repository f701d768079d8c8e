#include "base/positions/ClockOffset.h"

#include "base/positions/Alignment.h"

#include <limits>

namespace scanloom
{
namespace
{
constexpr Duration kRange = 2s, kOffsetStep = 50ms, kPrecision = 100us;
constexpr double kLeastSpeed = 0.05;          // m/s: error in position per second of offset
constexpr std::size_t kEnoughSamples = 2000;  // for speed: true poses of an hour at 100 Hz are 360000

PositionTrack thinned(const PositionTrack& track)
{
  const std::size_t every = 1 + track.size() / kEnoughSamples;
  PositionTrack result;
  for (std::size_t i = 0; i < track.size(); i += every) result.push_back(track[i]);
  return result;
}

/** Mean square distance in m^2. */
double disagreement(const std::vector<PositionPair>& pairs)
{
  if (pairs.empty()) return std::numeric_limits<double>::infinity();
  const Rigid reference_T_map = align(pairs, AlignmentKind::Yaw).reference_T_map;
  double squares = 0;
  for (const PositionPair& pair : pairs) squares += (reference_T_map * pair.map_p - pair.reference_p).squaredNorm();
  return squares / static_cast<double>(pairs.size());
}
}  // namespace

PositionTrack earlier(PositionTrack track, Duration offset)
{
  for (StampedPosition& sample : track) sample.stamp -= offset;
  return track;
}

std::optional<Duration> clockOffset(const Trajectory& estimate, const Eigen::Vector3d& body_p_point,
                                    const PositionTrack& whole_reference)
{
  const PositionTrack reference = thinned(whole_reference);
  const auto cost = [&](Duration offset)
  { return disagreement(pairsAtReference(estimate, body_p_point, earlier(reference, offset))); };

  Duration best{0};
  double least = cost(best);
  const auto consider = [&](Duration offset)
  {
    const double found = cost(offset);
    if (found >= least) return;
    least = found;
    best = offset;
  };
  for (Duration offset = -kRange; offset <= kRange; offset += kOffsetStep) consider(offset);
  if (best <= -kRange || best >= kRange) return std::nullopt;

  // Near its minimum the cost is least + (speed * offset)^2.
  const double rise = cost(best - kOffsetStep) + cost(best + kOffsetStep) - 2 * least;
  const double step = seconds(kOffsetStep);
  if (!(rise > 2 * kLeastSpeed * kLeastSpeed * step * step)) return std::nullopt;

  for (Duration step_size = kOffsetStep / 2; step_size >= kPrecision / 2; step_size /= 2)
  {
    const Duration middle = best;
    consider(middle - step_size);
    consider(middle + step_size);
  }
  return best;
}
}  // namespace scanloom
