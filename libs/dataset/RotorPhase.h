/** When a lidar's rotor passes its column 0, and how fast it turns. */
#pragma once
#include "dataset/PacketRuns.h"

#include <optional>

namespace scanloom
{
struct RotorPhase
{
  double at_start = 0, at_end = 0;  // s after a whole multiple of the nominal turn, in [0, turn)
  double scatter = 0;               // s, standard deviation about a steady rotor
  double rate_error_ppm = 0;        // of the turn rate against nominal, by the lidar's own clock
  double turn = 0;                  // s, nominal

  /** Kept where it is, by a phase lock or by chance: it moved by less than a hundredth of a turn. */
  bool steady() const;
};

/** Of the last run, since its last clock step; none with less than two turns. */
std::optional<RotorPhase> rotorPhase(const std::vector<PacketRun>&, const LidarDescription&, Duration least_step);
}  // namespace scanloom
