/** Diagrams of a study as gnuplot scripts that hold their data; the terminal is the caller's. */
#pragma once
#include "study/Study.h"

#include <string>
#include <vector>

namespace scanloom
{
/**
 * Of one stand: bars of medians, groups of N (and settings), one bar for each set of lidars, a dot per run. Runs that
 * were lost are crosses above the axis' end, and where the median is lost the bar is hatched up to there.
 */
std::string barsScript(const std::vector<StudyCell>& of_one_stand, const Quantity&);

/** Of one stand: the median error over the distance, a line per cell; runs that were lost or failed are left out. */
std::string driftOverDistanceScript(const std::vector<StudyCell>& of_one_stand);

/** The same distance for every run of a cell: medians at whole twentieths of the longest path. */
std::vector<ErrorAtDistance> medianOverDistance(const StudyCell&);
}  // namespace scanloom
