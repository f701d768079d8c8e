#include "mrpt_bridge/RawlogReader.h"

#include <utility>

namespace scanloom
{
std::optional<RecordingHeader> headerIn(const mrpt::obs::CObservation& observation)
{
  const auto* comment = dynamic_cast<const mrpt::obs::CObservationComment*>(&observation);
  return comment ? recordingHeaderFromJson(comment->text) : std::nullopt;
}

RawlogReader::RawlogReader(const std::filesystem::path& path) : observations_(path), first_(observations_.next())
{
  if (first_) header_ = headerIn(*first_);
  if (header_) first_.reset();
}

std::optional<RecordedEvent> RawlogReader::next()
{
  const auto observation = first_ ? std::exchange(first_, nullptr) : observations_.next();
  if (!observation) return std::nullopt;

  if (const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(observation.get()))
    return RecordedScan{fromObservation(*cloud, header_), cloud->sensorLabel};
  if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(observation.get()))
    if (auto recorded = fromObservation(*imu)) return *std::move(recorded);
  return observation;
}
}  // namespace scanloom
