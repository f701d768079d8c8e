/** The report of an experiment: one file that needs nothing else to be read. */
#pragma once
#include "study/Study.h"

#include <functional>
#include <string>

namespace scanloom
{
/** An SVG element of a gnuplot script. */
using Draw = std::function<std::string(const std::string& script)>;

/** A page of HTML without scripts and without links to other places but the results beside it. */
std::string htmlReport(const Study&, const std::string& configuration, const Draw&);
}  // namespace scanloom
