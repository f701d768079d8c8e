#pragma once
#include "slam/StateEstimate.h"

#include <string>

namespace scanloom
{
/**
 * Where a person sees from the machine what the lidars leave open: "open ahead", "open sideways", "open upwards", "open
 * in heading", "open in tilt", joined by commas; or why the registration is not trusted otherwise.
 */
std::string openDirection(const StateEstimate&);
}  // namespace scanloom
