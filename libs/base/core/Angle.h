#pragma once
#include <cmath>

namespace scanloom
{
inline constexpr double kDegree = M_PI / 180;  // rad
}  // namespace scanloom
