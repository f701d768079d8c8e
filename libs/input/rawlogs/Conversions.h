/** Times and poses as MRPT's types, and back. */
#pragma once
#include "base/core/Rigid.h"
#include "base/core/Time.h"

#include <mrpt/core/Clock.h>
#include <mrpt/poses/CPose3D.h>

namespace scanloom
{
/** MRPT counts ticks of 100 ns. Rounds down, so that no time relative to the result is negative. */
mrpt::Clock::time_point toMrpt(Timestamp stamp);

/** Times before 1677 or after 2262, which 64 bits of ns do not hold, become the nearest that they hold. */
Timestamp fromMrpt(mrpt::Clock::time_point);

mrpt::poses::CPose3D toMrpt(const Rigid&);
Rigid fromMrpt(const mrpt::poses::CPose3D&);
}  // namespace scanloom
