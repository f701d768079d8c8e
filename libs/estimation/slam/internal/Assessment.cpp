#include "estimation/slam/internal/Assessment.h"

namespace scanloom
{
Assessment assess(Timestamp stamp, bool trusted, const TrustHistory& history, const TrustOptions& options)
{
  const bool initialising = history.initialising_until && stamp <= *history.initialising_until;
  Assessment a;
  a.contradicted = options.contradiction > 0 && history.contradiction.median() > options.contradiction;
  a.last_trusted = trusted && !a.contradicted ? stamp : history.last_trusted;
  if (a.contradicted || stamp - a.last_trusted > fromSeconds(options.lost_after))
    a.health = Health::Lost;
  else if (initialising)
    a.health = Health::Initialising;
  else
    a.health = trusted && history.divergence.level() < Divergence::Apparent && !history.imu_silent ? Health::Ok
                                                                                                   : Health::Degenerate;
  return a;
}
}  // namespace scanloom
