/** The rim: our time and poses as MRPT's, and back. Inside the house they are int64 ns and Rigid. */
#pragma once
#include "core/Rigid.h"
#include "core/Time.h"

#include <mrpt/core/Clock.h>
#include <mrpt/poses/CPose3D.h>

namespace scanloom
{
/** MRPT counts 100 ns ticks since 1601: rounds down, so that nothing measured after `stamp` gets a negative offset. */
mrpt::Clock::time_point toMrpt(Timestamp stamp);
/** What 64 bits of nanoseconds do not hold (before 1677, after 2262) becomes the nearest that they do. */
Timestamp fromMrpt(mrpt::Clock::time_point);

mrpt::poses::CPose3D toMrpt(const Rigid&);
Rigid fromMrpt(const mrpt::poses::CPose3D&);
}  // namespace scanloom
