/** What `scanloom info` and `scanloom edit --info` say of a rawlog: for persons and for programs. */
#pragma once
#include "mrpt_bridge/RawlogInfo.h"

#include <nlohmann/json.hpp>

namespace scanloom
{
nlohmann::json toJson(const RawlogInfo&);

/** To stdout. */
void print(const RawlogInfo&);
}  // namespace scanloom
