#include "mrpt/edit/internal/RawlogLabels.h"

#include "base/config/Names.h"
#include "base/core/ConfigError.h"
#include "mrpt/observations/RawlogReader.h"

#include <fmt/format.h>
#include <mrpt/obs/CObservation.h>

namespace scanloom
{
namespace
{
RawlogOperation filter(const std::set<std::string>& labels, bool kept)
{
  return [labels = WantedLabels(labels), kept](const ObservationPtr& observation) mutable -> Observations
  {
    if (!observation)
    {
      labels.requireAllSeen();
      return {};
    }
    const bool stays = headerIn(*observation) || labels.contain(*observation) == kept;
    return stays ? Observations{observation} : Observations{};
  };
}
}  // namespace

bool WantedLabels::contain(const mrpt::obs::CObservation& observation)
{
  seen_.insert(observation.sensorLabel);
  return wanted_.count(observation.sensorLabel) > 0;
}

void WantedLabels::requireAllSeen() const
{
  for (const std::string& label : wanted_)
    if (seen_.count(label) == 0)
      throw UsageError(
          fmt::format("no observation has the label '{}': {}", label, suggestion(label, {seen_.begin(), seen_.end()})));
}

RawlogOperation keepLabels(const std::set<std::string>& labels) { return filter(labels, true); }

RawlogOperation removeLabels(const std::set<std::string>& labels) { return filter(labels, false); }
}  // namespace scanloom
