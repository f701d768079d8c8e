/** What `scanloom evaluate` says: for persons and for programs. */
#pragma once
#include "evaluation/Evaluation.h"
#include "evaluation/PositionError.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace scanloom
{
/** Keys are explained in doc/study.md; null is what cannot be told. */
nlohmann::json toJson(const Evaluation&);
std::string toText(const Evaluation&);

nlohmann::json toJson(const PositionError&);
std::string toText(const PositionError&);
}  // namespace scanloom
