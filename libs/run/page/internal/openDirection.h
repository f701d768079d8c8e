#pragma once
#include "estimation/slam/StateEstimate.h"

#include <string>

namespace scanloom
{
/**
 * What the lidars leave open, as a person on the machine sees it: "open ahead", "open ahead to the left" (a line
 * between two axes), "open sideways", "open upwards", "open in heading", "open in tilt", joined by commas; or why the
 * registration is not trusted otherwise.
 */
std::string openDirection(const StateEstimate&);
}  // namespace scanloom
