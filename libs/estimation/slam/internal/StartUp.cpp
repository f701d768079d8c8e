#include "estimation/slam/internal/StartUp.h"

#include "estimation/ndt/FittedConstants.h"
#include "estimation/slam/internal/requireGravity.h"

#include <algorithm>
#include <utility>

namespace scanloom
{
namespace
{
/** Velocity of the first state in the map frame: the smoother's window still holds that state after a few scans. */
Eigen::Vector3d velocityByTrial(const std::deque<Scan>& scans, const ImuBuffer& imu, const Tracker& tracker,
                                TrackerState state)
{
  const auto window = static_cast<std::size_t>(state.window.smoother.options().window);
  const std::size_t count = std::min({scans.size(), fitted::kTrialScans, window - 1});
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::vector<ImuSample> samples = imu.between(state.window.smoother.newest().stamp, scans[i].end());
    state = tracker.step(std::move(state), scans[i], samples).state;
  }
  return state.window.smoother.states().front().velocity;
}
}  // namespace

std::optional<TrackerState> startUp(const WaitingScans& waiting, const ImuBuffer& imu, const MountedImu& placed,
                                    const StandstillOptions& options, const Tracker& tracker)
{
  if (waiting.scans().empty() || imu.empty()) return std::nullopt;
  const Scan& first = waiting.scans().front();
  const bool enough_for_trial = waiting.inputEnded() || waiting.scans().size() >= fitted::kTrialScans;
  if (placed.assumed && !enough_for_trial) return std::nullopt;
  const Timestamp enough = placed.assumed
                               ? waiting.scans()[std::min(waiting.scans().size(), fitted::kTrialScans) - 1].end()
                               : first.start + fromSeconds(options.duration);
  if (!waiting.inputEnded() && !imu.covers(first.start, enough)) return std::nullopt;

  const Timestamp to = std::min(enough, std::max(imu.samples().back().stamp, first.end()));
  const std::vector<ImuSample> samples = imu.between(first.start, to);
  requireGravity(samples, placed.body_T_imu);
  const double bias_sigma = placed.noise.accel_bias_sigma;
  std::optional<NavEstimate> initial;
  if (!placed.assumed) initial = initialiseAtRest(samples, placed.body_T_imu, options, bias_sigma);
  const bool at_rest = initial.has_value();
  if (!at_rest && !enough_for_trial) return std::nullopt;
  if (!at_rest)
    initial = placed.assumed ? levelWithBody(first.start) : gravityOnly(samples, placed.body_T_imu, bias_sigma);
  initial->state.stamp = first.start;

  TrackerState state = tracker.begin(*initial, placed);
  if (at_rest) return state;
  initial->state.velocity = velocityByTrial(waiting.scans(), imu, tracker, std::move(state));
  state = tracker.begin(*initial, placed);
  state.trust.initialising_until = enough;
  return state;
}
}  // namespace scanloom
