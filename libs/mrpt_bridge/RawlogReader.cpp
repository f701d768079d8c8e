#include "mrpt_bridge/RawlogReader.h"

#include "mrpt_bridge/RecordingHeaderJson.h"

#include <utility>

namespace scanloom
{
namespace
{
RecordedEvent eventOf(const mrpt::obs::CObservation::Ptr& observation, const std::optional<RecordingHeader>& header)
{
  if (isSlice(*observation)) return observation;
  if (const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(observation.get()))
    return RecordedScan{fromObservation(*cloud, header), cloud->sensorLabel};
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
  while (released_.empty())
  {
    const auto observation = first_ ? std::exchange(first_, nullptr) : observations_.next();
    if (observation)
      take(eventOf(observation, header_));
    else if (held_.empty())
      return std::nullopt;
    else
      releaseScansUntil(Timestamp::max());
  }
  RecordedEvent event = std::move(released_.front());
  released_.pop_front();
  return event;
}

void RawlogReader::take(RecordedEvent event)
{
  if (auto* scan = std::get_if<RecordedScan>(&event))
  {
    releaseScansUntil(scan->scan.start);
    held_.push_back(std::move(*scan));
    return;
  }
  if (const auto* imu = std::get_if<RecordedImu>(&event)) releaseScansUntil(imu->sample.stamp);
  released_.push_back(std::move(event));
}

/** Scans of one label do not overlap: the one that was held first ends first. */
void RawlogReader::releaseScansUntil(Timestamp stamp)
{
  for (; !held_.empty() && held_.front().scan.end() <= stamp; held_.pop_front())
    released_.emplace_back(std::move(held_.front()));
}
}  // namespace scanloom
