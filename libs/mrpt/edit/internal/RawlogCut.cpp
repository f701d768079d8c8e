#include "mrpt/edit/internal/RawlogCut.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/observations/RawlogReader.h"

#include <mrpt/obs/CObservation.h>

namespace scanloom
{
namespace
{
template <typename T>
bool within(const T& value, const std::optional<T>& from, const std::optional<T>& to)
{
  return (!from || value >= *from) && (!to || value <= *to);
}
}  // namespace

RawlogOperation cutTo(const RawlogSpan& span)
{
  return [span, index = std::uint64_t{0}](const ObservationPtr& observation) mutable -> Observations
  {
    if (!observation) return {};
    const std::uint64_t place = index++;
    if (headerIn(*observation)) return {observation};
    const bool wanted = within(place, span.from_index, span.to_index) &&
                        within(fromMrpt(observation->timestamp), span.from_time, span.to_time);
    return wanted ? Observations{observation} : Observations{};
  };
}
}  // namespace scanloom
