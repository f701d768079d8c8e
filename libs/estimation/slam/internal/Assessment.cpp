#include "estimation/slam/internal/Assessment.h"

namespace scanloom
{
Assessment assess(const StateEstimate& estimate, bool opens_map, const TrustHistory& history,
                  const TrustOptions& options)
{
  const bool trusted = opens_map || estimate.trusted;
  const bool initialising = history.initialising_until && estimate.stamp <= *history.initialising_until;
  Assessment a;
  a.contradicted = options.contradiction > 0 && history.contradiction.median() > options.contradiction;
  a.last_trusted = trusted && !a.contradicted ? estimate.stamp : history.last_trusted;
  if (a.contradicted || estimate.stamp - a.last_trusted > fromSeconds(options.lost_after))
    a.health = Health::Lost;
  else if (initialising)
    a.health = Health::Initialising;
  else
    a.health = trusted && history.divergence.level() < Divergence::Apparent && !history.imu_silent ? Health::Ok
                                                                                                   : Health::Degenerate;
  return a;
}
}  // namespace scanloom
