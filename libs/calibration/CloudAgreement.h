/** Whether two lidars see the same things in the same place, which checks their poses on the body. */
#pragma once
#include "calibration/internal/OverlapOverTurns.h"

#include <optional>
#include <vector>

namespace scanloom
{
struct CloudAgreement
{
  std::size_t turns = 0;  // these four as in OverlapOverTurns
  std::size_t common = 0;
  double near_share = 0, near_sigma = 0;

  /**
   * How A's sensor must move and turn (in the body's axes) if B's pose is right. None with fewer than three turns, or
   * if registration found no better pose.
   */
  struct Correction
  {
    Eigen::Vector3d offset, rotation;     // m, rad
    double offset_sigma, rotation_sigma;  // standard deviations, by leaving out one turn at a time
    double near_share;                    // after the correction
    double score_gain;                    // of the registration: after the correction over before it
  };
  std::optional<Correction> correction;
};

/**
 * Registers all turns at once (D2D NDT). First come the points that are not on the machine, with coarse cells, because
 * two sides of one part of the machine, each seen by one lidar, would be matched to each other; then all points with
 * fine cells. None if no turn has enough common points.
 */
std::optional<CloudAgreement> cloudAgreement(const std::vector<SeenByBoth>&, const Rigid& body_T_a,
                                             const Rigid& body_T_b);
}  // namespace scanloom
