#include "input/batching/internal/BatcherOptions.h"

#include <fmt/format.h>

#include <stdexcept>

namespace scanloom
{
OtherClock otherClockFromName(const std::string& name)
{
  if (name == "align") return OtherClock::Align;
  if (name == "quarantine") return OtherClock::Quarantine;
  if (name == "refuse") return OtherClock::Refuse;
  throw std::invalid_argument(fmt::format("other_clock = {}: must be align, quarantine or refuse", name));
}
}  // namespace scanloom
