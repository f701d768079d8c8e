/** A part of a rawlog: from one time or object to another. */
#pragma once
#include "base/core/Time.h"
#include "mrpt/edit/RawlogEdit.h"

#include <optional>

namespace scanloom
{
/** Both ends are included; without a value the span reaches to the end of the file. */
struct RawlogSpan
{
  std::optional<Timestamp> from_time, to_time;
  std::optional<std::uint64_t> from_index, to_index;  // place in the file; the first object is 0

  bool isWhole() const { return !from_time && !to_time && !from_index && !to_index; }
};

/** Keeps the observations whose stamp (of a scan its start) and place are within the span, and the header. */
RawlogOperation cutTo(const RawlogSpan&);
}  // namespace scanloom
