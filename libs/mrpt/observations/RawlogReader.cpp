#include "mrpt/observations/RawlogReader.h"

#include "base/config/MrptMessage.h"
#include "mrpt/observations/RecordingHeaderJson.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <iterator>
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
  while (released_.empty())
  {
    const auto observation = first_ ? std::exchange(first_, nullptr) : observations_.next();
    if (observation)
      takeSound(observation);
    else if (held_.empty())
      return std::nullopt;
    else
      releaseScansUntil(Timestamp::max());
  }
  RecordedEvent event = std::move(released_.front());
  released_.pop_front();
  return event;
}

void RawlogReader::takeSound(const mrpt::obs::CObservation::Ptr& observation)
{
  try
  {
    take(eventOf(observation, header_));
  }
  catch (const std::exception& e)  // of MRPT, too: a cloud in a file of its own that cannot be read
  {
    observations_.endBecause(
        fmt::format("an observation of '{}' is damaged: {}", observation->sensorLabel, messageIn(e.what())));
  }
}

void RawlogReader::take(RecordedEvent event)
{
  if (auto* scan = std::get_if<RecordedScan>(&event))
  {
    releaseScansUntil(scan->scan.start);
    releaseScansOf(scan->label);
    held_.push_back(std::move(*scan));
    return;
  }
  if (const auto* imu = std::get_if<RecordedImu>(&event)) releaseScansUntil(imu->sample.stamp);
  released_.push_back(std::move(event));
}

void RawlogReader::releaseScansUntil(Timestamp stamp)
{
  for (; !held_.empty() && held_.front().scan.end() <= stamp; held_.pop_front())
    released_.emplace_back(std::move(held_.front()));
}

/** Scans of one label do not overlap. Without this, one stamp far ahead would hold back all that follows. */
void RawlogReader::releaseScansOf(const std::string& label)
{
  const auto over =
      std::stable_partition(held_.begin(), held_.end(), [&](const RecordedScan& scan) { return scan.label != label; });
  std::move(over, held_.end(), std::back_inserter(released_));
  held_.erase(over, held_.end());
}
}  // namespace scanloom
