#pragma once
#include "batching/Scan.h"
#include "mrpt_bridge/ObservationReader.h"
#include "mrpt_bridge/Observations.h"
#include "mrpt_bridge/RecordingHeader.h"

#include <deque>
#include <optional>
#include <variant>

namespace scanloom
{
struct RecordedScan
{
  Scan scan;
  std::string label;
};

/** Whatever else a rawlog holds, comments but the header included. */
using OtherObservation = mrpt::obs::CObservation::Ptr;

using RecordedEvent = std::variant<RecordedScan, RecordedImu, OtherObservation>;

/**
 * Streams a rawlog in the file's order, but that a scan comes after all IMU samples of its period, as from the batcher:
 * rawlog-grabber sorts by stamp, and a scan's is its start. A damaged file is read up to the damage; damage() then says
 * what and where: ask it once next() has returned nothing.
 */
class RawlogReader
{
 public:
  /** Throws std::runtime_error if the file can't be opened, std::invalid_argument if its header is ours but damaged. */
  explicit RawlogReader(const std::filesystem::path&);

  /** Known from the start; nothing if the rawlog's first object is not a header. */
  const std::optional<RecordingHeader>& header() const { return header_; }

  std::optional<RecordedEvent> next();

  /** Empty if all is well so far. */
  const std::string& damage() const { return observations_.damage(); }

 private:
  void take(RecordedEvent);
  void releaseScansUntil(Timestamp);

  ObservationReader observations_;
  std::optional<RecordingHeader> header_;
  std::deque<RecordedScan> held_;  // their period may not be over yet
  std::deque<RecordedEvent> released_;
  mrpt::obs::CObservation::Ptr first_;  // read ahead in search of the header
};

/** The header that an observation carries, if it does; throws as recordingHeaderFromJson. */
std::optional<RecordingHeader> headerIn(const mrpt::obs::CObservation&);
}  // namespace scanloom
