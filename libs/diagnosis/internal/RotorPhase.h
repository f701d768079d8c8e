/** When a lidar's rotor passes its column 0, and how fast it turns. */
#pragma once
#include "diagnosis/internal/PacketRuns.h"

#include <optional>

namespace scanloom
{
struct RotorPhase
{
  double at_start = 0, at_end = 0;  // time of column 0 in s, modulo the nominal turn
  double scatter = 0;               // s, standard deviation about a steady rotor
  double rate_error_ppm = 0;        // turn rate against nominal, by the lidar's own clock
  double turn = 0;                  // s, nominal

  /** The phase moved by less than a hundredth of a turn from start to end. */
  bool steady() const;
};

/** From the last run after its last clock step; none if that is less than two turns. */
std::optional<RotorPhase> rotorPhase(const std::vector<PacketRun>&, const LidarDescription&, Duration least_step);
}  // namespace scanloom
