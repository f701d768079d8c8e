/** Whether two lidars see the same world in the same place: what their poses on the body are worth. */
#pragma once
#include "core/Rigid.h"
#include "dataset/Snapshots.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** The same while seen by both. */
struct SnapshotPair
{
  const Snapshot* a;
  const Snapshot* b;
};

struct CloudAgreement
{
  std::size_t turns = 0;   // with at least 500 common points
  std::size_t common = 0;  // points of A's surroundings that B should see, per turn: near enough for its beams to lie
                           // 0.6 m apart at most, and nothing in between
  double near_share = 0;   // of those: with a point of B within 0.3 m

  /** How A's sensor should move and turn (in the body's axes) if B is where it is said to be. None if the registration
   * found nothing better. */
  struct Correction
  {
    Eigen::Vector3d offset, rotation;     // m, rad
    double offset_sigma, rotation_sigma;  // standard deviations, by leaving out one turn at a time
    double near_share;                    // with it
  };
  std::optional<Correction> correction;
};

/**
 * Registers all turns at once (D2D NDT): first what surrounds the machine, with coarse cells, since the two sides of a
 * part of the machine, each seen by one lidar, would be taken for one; from there all points with fine cells. None
 * without a turn with common points.
 */
std::optional<CloudAgreement> cloudAgreement(const std::vector<SnapshotPair>&, const Rigid& body_T_a,
                                             const Rigid& body_T_b);
}  // namespace scanloom
