/** The results of `scanloom evaluate` as text and as JSON. */
#pragma once
#include "lab/evaluation/Evaluation.h"
#include "lab/evaluation/PositionError.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace scanloom
{
/** doc/study.md explains the keys; null: the value is not known. */
nlohmann::json toJson(const Evaluation&);
std::string toText(const Evaluation&);

nlohmann::json toJson(const PositionError&);
std::string toText(const PositionError&);
}  // namespace scanloom
