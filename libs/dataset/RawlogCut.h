/** A part of a rawlog: from one time or object to another. */
#pragma once
#include "core/Time.h"
#include "dataset/RawlogEdit.h"

#include <optional>

namespace scanloom
{
/** All ends belong to it; those not given are the file's. */
struct RawlogSpan
{
  std::optional<Timestamp> from_time, to_time;
  std::optional<std::uint64_t> from_index, to_index;  // by place in the file; the first object is 0

  bool isWhole() const { return !from_time && !to_time && !from_index && !to_index; }
};

/** The observations whose stamp (a scan's is its start) and place are within; the header is always kept. */
RawlogOperation cutTo(const RawlogSpan&);
}  // namespace scanloom
