#pragma once
#include "dataset/Finding.h"
#include "dataset/RigExamination.h"

#include <string>

namespace scanloom
{
/** Every measure and every finding; times in s, rates in Hz, shares 0 to 1, absent where not measured. */
std::string toJson(const RigExamination&, const Findings&);
}  // namespace scanloom
