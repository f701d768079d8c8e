/** Diagrams of a study: gnuplot scripts with their data, but without `set terminal`. */
#pragma once
#include "lab/study/internal/Study.h"

#include <string>
#include <vector>

namespace scanloom
{
struct Bar
{
  std::string group, series;  // the group gives its place, the series its colour
  CellSummary summary;
};

/** One group per N and varied settings, in it one bar per set of lidars. */
std::vector<Bar> barsOf(const std::vector<StudyCell>& of_one_stand, const Quantity&);

/** Medians as bars, with a dot per run. Lost runs are crosses at the top; the bar of a lost median is hatched. */
std::string barsScript(const std::vector<Bar>&, const std::string& axis);

/** The cells of each figure: all in one if their lines can be distinguished, otherwise one figure per set of lidars. */
std::vector<std::vector<StudyCell>> byLines(const std::vector<StudyCell>& of_one_stand);

/** The median error over the distance, one line per cell, without lost and failed runs. */
std::string driftOverDistanceScript(const std::vector<StudyCell>& of_one_stand);

/** Medians over the runs of a cell, at each twentieth of the longest path. */
std::vector<ErrorAtDistance> medianOverDistance(const StudyCell&);
}  // namespace scanloom
