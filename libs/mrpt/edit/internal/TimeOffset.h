#pragma once
#include "base/core/Time.h"
#include "mrpt/edit/RawlogEdit.h"

#include <string>

namespace scanloom
{
/**
 * Adds `offset`, rounded to MRPT's 100 ns, to the stamps of one label and moves these observations to where they then
 * belong: an observation is due at its stamp, a cloud at its stamp plus `period`. Observations with the label keep
 * their order among themselves, and so do the others. Observations that span the offset are held in memory; if they
 * were more than some hundred clouds (clocks far apart), the oldest are released early. Throws UsageError at the end of
 * input if no observation had the label.
 */
RawlogOperation addTimeOffset(const std::string& label, Duration offset, Duration period);
}  // namespace scanloom
