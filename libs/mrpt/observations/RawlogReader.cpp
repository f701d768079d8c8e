#include "mrpt/observations/RawlogReader.h"

#include "base/config/MrptMessage.h"
#include "mrpt/observations/RecordingHeaderJson.h"

#include <fmt/format.h>

#include <exception>
#include <utility>

namespace scanloom
{
namespace
{
RecordedEvent eventOf(const mrpt::obs::CObservation::Ptr& observation, const std::optional<RecordingHeader>& header)
{
  if (isSlice(*observation)) return observation;
  if (const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(observation.get()))
    return RecordedScan{measuredScan(*cloud, header), cloud->sensorLabel};
  if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(observation.get()))
    if (auto recorded = fromObservation(*imu)) return *std::move(recorded);
  return observation;
}
}  // namespace

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
  try
  {
    return eventOf(observation, header_);
  }
  catch (const std::exception& e)  // of MRPT, too: a cloud in a file of its own that cannot be read
  {
    observations_.endBecause(
        fmt::format("an observation of '{}' is damaged: {}", observation->sensorLabel, messageIn(e.what())));
    return std::nullopt;
  }
}
}  // namespace scanloom
