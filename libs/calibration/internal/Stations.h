/** Places of a drive at which what two lidars saw there and near there is compared. */
#pragma once
#include "calibration/Extrinsics.h"

#include <vector>

namespace scanloom
{
struct Station
{
  Timestamp at;
  std::vector<const LidarScan*> scans;  // of the lidar that is calibrated; the first is at the instant
  std::vector<View> reference;          // of the reference lidar, in the body's frame at the instant
  Vector6d twist;                       // m/s and rad/s, of the body in its own frame
  Stems stems = Stems::AsSeen;          // in the views of both
};

/** What belongs to a station. */
struct Surroundings
{
  double reach;  // m: scans from up to so far around
  Stems stems = Stems::AsSeen;
};

/**
 * At most 60, evenly chosen, at least 0.7 m or 10 deg apart: a machine at rest gives a single one. The scans of both
 * lidars are 1 m or 10 deg apart, from all around: what one lidar sees first and another later is compared as well. The
 * farther, the more the error of the path counts.
 *
 * Both lidars have scans from all around: leaves, and stems, are seen from one side in a single scan, and in many from
 * many. One scan against many gave errors of 5 mm in a sparse stand and 20 mm and 0.1 deg in a dense one.
 */
std::vector<Station> stationsOf(const std::vector<LidarScan>& of_lidar, const std::vector<LidarScan>& of_reference,
                                const Extrinsics& reference, const Trajectory&, const Surroundings&);

/** Those at least 1 m or 10 deg apart. */
std::vector<const LidarScan*> scansApart(const std::vector<LidarScan>&, const Trajectory&);
}  // namespace scanloom
