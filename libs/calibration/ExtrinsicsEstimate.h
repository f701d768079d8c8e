/** Pose and clock of a lidar on the body by what a reference lidar saw at the same places of a drive. */
#pragma once
#include "calibration/ExtrinsicsSearch.h"
#include "calibration/internal/ExtrinsicsCovariance.h"
#include "calibration/internal/StationMaps.h"

#include <vector>

namespace scanloom
{
enum class ExtrinsicsOutcome
{
  Estimated,
  Open,           // but for some directions, which keep the given values
  StoodStill,     // fewer than ten stations: no covariance, so no number is trusted
  NothingShared,  // less than a tenth of its points are where the reference saw something
  Unstable,       // it did not settle, or does not fit
  Contradicted,   // the IMUs in the lidars measure another rotation between them
};

/** The extrinsics are those given, unless Estimated or Open. */
struct ExtrinsicsEstimate : ObservableExtrinsics
{
  ExtrinsicsOutcome outcome = ExtrinsicsOutcome::StoodStill;
  std::size_t stations = 0;
  double shared_before = 0, shared_after = 0;      // share of points that are where the reference saw something
  double distance_before = 0, distance_after = 0;  // m, surfaceDistance
  double distance_of_reference = 0;                // m, distanceWithinReference
};

/** Estimated or Open, by the covariance (in metres, see observableExtrinsics). */
ExtrinsicsEstimate observable(ExtrinsicsEstimate, const Extrinsics& estimate, const Matrix7d& covariance,
                              const Extrinsics& given);

/**
 * D2D NDT (ndt/Registration.h) from `start` (findStart), with cells of 2 m, then 1 m; scans are deskewed anew with each
 * better extrinsics. `given` is what is known without the drive: open directions keep it. The start's rival doubts it.
 */
ExtrinsicsEstimate estimateExtrinsics(const std::vector<Station>&, const Extrinsics& given,
                                      const ExtrinsicsStart& start, const Trajectory&, Clock, const RotationByImus&);

/**
 * An estimate that another one, by other scans, contradicts: what lies between the two is added to its covariance as
 * one standard deviation, so that directions in which they differ by more than a tape measure are open.
 */
ExtrinsicsEstimate doubted(ExtrinsicsEstimate, const Extrinsics& by, const Extrinsics& given);
}  // namespace scanloom
