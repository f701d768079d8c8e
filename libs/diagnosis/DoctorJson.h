#pragma once
#include "base/core/Finding.h"
#include "diagnosis/internal/RigExamination.h"

#include <string>

namespace scanloom
{
/** Every measure and every finding: times in s, rates in Hz, shares 0 to 1. What was not measured is absent. */
std::string toJson(const RigExamination&, const Findings&);
}  // namespace scanloom
