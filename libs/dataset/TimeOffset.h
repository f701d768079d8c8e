#pragma once
#include "core/Time.h"
#include "dataset/RawlogEdit.h"

#include <string>

namespace scanloom
{
/**
 * Adds `offset`, rounded to MRPT's 100 ns, to the stamps of one label, and puts these observations where they then
 * belong: an observation is due at its stamp, a cloud `period` later. The others keep their order, and so do these.
 * What is held for that spans the offset; of clocks so far apart that this would be more than some hundred clouds, the
 * oldest are let go. At the end of input throws UsageError if no observation had the label.
 */
RawlogOperation addTimeOffset(const std::string& label, Duration offset, Duration period);
}  // namespace scanloom
