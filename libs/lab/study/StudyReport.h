/** The report of an experiment: one self-contained HTML file. */
#pragma once
#include "lab/study/internal/Study.h"

#include <functional>
#include <string>

namespace scanloom
{
/** Turns a gnuplot script into an SVG element. */
using Draw = std::function<std::string(const std::string& script)>;

/** HTML without scripts; its only links are those to results.csv and results.json in the same folder. */
std::string htmlReport(const Study&, const std::string& configuration, const Draw&);
}  // namespace scanloom
