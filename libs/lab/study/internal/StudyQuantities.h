/** The quantities of a report. */
#pragma once
#include "lab/study/internal/Study.h"

#include <set>
#include <string>
#include <vector>

namespace scanloom
{
/** Of the scans' poses, in m. */
const Quantity& drift();

/** Mean time of a stage of slam. */
Quantity millisecondsOf(const std::string& stage);

/** Those with a figure of their own. */
std::vector<Quantity> drawnQuantities();

/** Columns of the tables. */
std::vector<Quantity> errorQuantities();
std::vector<Quantity> costQuantities(const std::vector<StudyCell>&);

/** The stages of all runs. */
std::set<std::string> stagesOf(const std::vector<StudyCell>&);
}  // namespace scanloom
