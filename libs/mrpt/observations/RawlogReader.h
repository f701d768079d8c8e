#pragma once
#include "input/batching/Scan.h"
#include "input/rig/RecordingHeader.h"
#include "mrpt/observations/ObservationReader.h"
#include "mrpt/observations/Observations.h"

#include <optional>
#include <variant>

namespace scanloom
{
struct RecordedScan
{
  Scan scan;
  std::string label;
};

/** Any other observation; the header is none of them. */
using OtherObservation = mrpt::obs::CObservation::Ptr;

using RecordedEvent = std::variant<RecordedScan, RecordedImu, OtherObservation>;

/**
 * A rawlog event by event, in the file's order. A damaged file is read up to the damage, and damage() then says what
 * and where. Points that no lidar measures are left out (measuredScan).
 */
class RawlogReader
{
 public:
  /** Throws std::runtime_error if the file cannot be opened, std::invalid_argument if its header is damaged. */
  explicit RawlogReader(const std::filesystem::path&);

  /** Known from the start; nothing if the rawlog's first object is not a header. */
  const std::optional<RecordingHeader>& header() const { return header_; }

  std::optional<RecordedEvent> next();

  /** Compressed bytes. */
  std::uint64_t bytesRead() const { return observations_.bytesRead(); }

  /** Empty if there is none so far. */
  const std::string& damage() const { return observations_.damage(); }

 private:
  ObservationReader observations_;
  std::optional<RecordingHeader> header_;
  mrpt::obs::CObservation::Ptr first_;  // read ahead in search of the header
};

/** The header that an observation carries, if it does; throws as recordingHeaderFromJson. */
std::optional<RecordingHeader> headerIn(const mrpt::obs::CObservation&);
}  // namespace scanloom
