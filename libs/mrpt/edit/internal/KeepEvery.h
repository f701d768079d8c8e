#pragma once
#include "mrpt/edit/RawlogEdit.h"

namespace scanloom
{
/** Keeps every `n`-th cloud of each label, the first included, and all that is no cloud. */
RawlogOperation keepEvery(std::uint64_t n);
}  // namespace scanloom
