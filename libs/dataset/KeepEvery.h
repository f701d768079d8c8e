#pragma once
#include "dataset/RawlogEdit.h"

namespace scanloom
{
/** One cloud of `n` of each label, from the first on, so that parts of one scan stay together; all else stays. */
RawlogOperation keepEvery(std::uint64_t n);
}  // namespace scanloom
