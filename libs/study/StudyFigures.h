/** Diagrams of a study as gnuplot scripts that hold their data; the terminal is the caller's. */
#pragma once
#include "study/Study.h"

#include <string>
#include <vector>

namespace scanloom
{
struct Bar
{
  std::string group, series;  // where it stands, and its colour
  CellSummary summary;
};

/** A group for each N (and settings that vary), a bar for each set of lidars. */
std::vector<Bar> barsOf(const std::vector<StudyCell>& of_one_stand, const Quantity&);

/** Bars of medians with a dot per run. Lost runs are crosses above all others, a lost median is hatched up to there. */
std::string barsScript(const std::vector<Bar>&, const std::string& axis);

/** One figure's worth of cells if their lines can be told apart, otherwise one for each set of lidars. */
std::vector<std::vector<StudyCell>> byLines(const std::vector<StudyCell>& of_one_stand);

/** Of one stand: the median error over the distance, a line per cell; runs that were lost or failed are left out. */
std::string driftOverDistanceScript(const std::vector<StudyCell>& of_one_stand);

/** The same distance for every run of a cell: medians at whole twentieths of the longest path. */
std::vector<ErrorAtDistance> medianOverDistance(const StudyCell&);
}  // namespace scanloom
