#include "mrpt/edit/internal/KeepEvery.h"

#include <mrpt/obs/CObservationPointCloud.h>

namespace scanloom
{
RawlogOperation keepEvery(std::uint64_t n)
{
  return [n, clouds = std::map<std::string, std::uint64_t>()](const ObservationPtr& observation) mutable -> Observations
  {
    if (!observation) return {};
    const bool is_cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(observation.get()) != nullptr;
    const bool stays = !is_cloud || clouds[observation->sensorLabel]++ % n == 0;
    return stays ? Observations{observation} : Observations{};
  };
}
}  // namespace scanloom
