#pragma once
#include "base/core/ImuSample.h"
#include "base/core/Rigid.h"

#include <vector>

namespace scanloom
{
/**
 * Check before the start: throws std::runtime_error with the unit or the wrong axis if the mean specific force of the
 * samples cannot be that of a machine on its wheels.
 */
void requireGravity(const std::vector<ImuSample>&, const Rigid& body_T_imu);
}  // namespace scanloom
