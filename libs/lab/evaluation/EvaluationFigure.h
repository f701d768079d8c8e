/** Diagrams of one evaluation: a gnuplot script with its data, but without `set terminal`. */
#pragma once
#include "lab/evaluation/Evaluation.h"

#include <string>

namespace scanloom
{
/** The paths from above, the height over time, and the error over distance, after the alignment of the drift. */
std::string figureScript(const Evaluation&);
}  // namespace scanloom
