/** A scan's pose in the local map. */
#pragma once
#include "base/core/StageTimes.h"
#include "estimation/ndt/Registration.h"
#include "estimation/ndt/View.h"

#include <functional>
#include <optional>
#include <vector>

namespace scanloom
{
/** Cells of the scan and options of the search, for the rough alignment and for the fine one after it. */
struct ScanRegistrationOptions
{
  NdtOptions scan_cells, fine_cells;
  RegistrationOptions rough, fine;
};

/** The same with so few steps that scans of a lost body take little longer than others: most searches fail. */
ScanRegistrationOptions withLimitedEffort(ScanRegistrationOptions);

/** Whether alignment with a scan's cells of this size finds the pose from the guess: not if its covariance is unknown.
 */
bool isWithinReach(const PoseGuess&, const NdtOptions& scan_cells);

/** First alignment (paper, section 2.2); through coarser cells where the guess may be too far off for scan_cells. */
Timed<RegistrationResult> registerRoughly(const NdtMap& map, const std::vector<View>& seen_from_body,
                                          const PoseGuess& map_T_body, const ScanRegistrationOptions&);

/** Second alignment, from the pose of the first. The result is the lidar's alone: no guess is part of it. */
Timed<RegistrationResult> registerFinely(const NdtMap& map, const std::vector<View>& seen_from_body,
                                         const Rigid& map_T_body, const ScanRegistrationOptions&);

/**
 * Fine alignment from the guess, whose covariance is known. It is enough if the guess is within its reach, and the
 * result agrees with the guess and fits nearly as well as `usual_score`, that of the last trusted scan. Else, as after
 * a false reading of the IMU, fine alignment from what a rough one finds, if that is trustworthy. Large cells confuse
 * places that look alike: where the second result contradicts the guess, and the first agrees with it and fits nearly
 * as well, it is the first.
 */
Timed<RegistrationResult> registerTwice(const NdtMap& map, const std::vector<View>& seen_from_body,
                                        const PoseGuess& map_T_body, std::optional<double> usual_score,
                                        const ScanRegistrationOptions&);

/** Distance of what was found from the prediction, whose covariance is known, in standard deviations of both; infinite
 * where rounding has left the sum of both covariances without an inverse. */
double mahalanobisOf(const RegistrationResult&, const PoseGuess& predicted);

/** A map in cells of several sizes, coarse first, made once for many searches. */
struct MapLevels
{
  explicit MapLevels(const NdtMap&);

  std::vector<NdtMap> levels;
};

/** Poses that are not the same, found twice. */
bool isFarFrom(const Rigid& pose, const Rigid& other);

/** Whether the pose of a body that may be anywhere can be right: stricter than trustworthy(), which suffices only where
 * the pose is known roughly. */
bool isPlace(const RegistrationResult&);

/** Score of what was seen with a map made of the same: no map gives much more. */
double scoreWithItself(const std::vector<View>& seen_from_body, const NdtOptions& map_cells, const NdtOptions& cells,
                       const RegistrationOptions&);

/**
 * The poses that alignment finds from the `count` most promising starts that are far from each other, best score first.
 * `level`: whose cells are large enough for poses between the starts. Nothing says that any of them is right.
 */
std::vector<RegistrationResult> placesFrom(const MapLevels&, std::size_t level, const std::vector<View>& seen_from_body,
                                           const std::vector<Rigid>& starts, std::size_t count, const NdtOptions& cells,
                                           const RegistrationOptions&);

/** Where a lost body is searched. */
struct SearchArea
{
  Rigid map_T_body;
  double radius = 3;  // m, to each side
  int headings = 8;   // evenly around, the pose's own first; one within 25 deg of the truth finds it: 8 cover all
};

/**
 * Covariance of a pose that was found in the area: the lidar's, limited by the area in directions that the lidar leaves
 * open (the radius, 25 deg of heading or any if all were tried, 15 deg of tilt).
 */
Matrix6d covarianceWithin(const SearchArea&, const RegistrationResult&);

/** Poses of the body from which a search in the area begins, the area's own heading first. */
std::vector<Rigid> startsWithin(const SearchArea&);

/**
 * The pose that alignment finds from the most promising start. None if it is not trustworthy or not possible, or if one
 * that is found from the next starts, far from it, is nearly as good. To fail takes a score for each start and about
 * two alignments.
 */
std::optional<RegistrationResult> relocalise(const NdtMap& map, const std::vector<View>& seen_from_body,
                                             const std::vector<Rigid>& starts,
                                             const std::function<bool(const Rigid& map_T_body)>& isPossible,
                                             const NdtOptions& cells, const RegistrationOptions&);
}  // namespace scanloom
