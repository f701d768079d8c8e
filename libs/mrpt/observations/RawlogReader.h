#pragma once
#include "input/batching/Scan.h"
#include "input/rig/RecordingHeader.h"
#include "mrpt/observations/ObservationReader.h"
#include "mrpt/observations/Observations.h"

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

/** Any other observation; the header is none of them. */
using OtherObservation = mrpt::obs::CObservation::Ptr;

using RecordedEvent = std::variant<RecordedScan, RecordedImu, OtherObservation>;

/**
 * A rawlog event by event. In the file a scan comes before the IMU samples of its period, because rawlog-grabber sorts
 * by stamp and a scan's stamp is its start. Here it comes after them, as from the batcher. A damaged file is read up to
 * the damage, and damage() then says what and where. Points that no lidar measures are left out (measuredScan).
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
  void takeSound(const mrpt::obs::CObservation::Ptr&);
  void take(RecordedEvent);
  void releaseScansUntil(Timestamp);
  void releaseScansOf(const std::string& label);

  ObservationReader observations_;
  std::optional<RecordingHeader> header_;
  std::deque<RecordedScan> held_;  // until their period is over
  std::deque<RecordedEvent> released_;
  mrpt::obs::CObservation::Ptr first_;  // read ahead in search of the header
};

/** The header that an observation carries, if it does; throws as recordingHeaderFromJson. */
std::optional<RecordingHeader> headerIn(const mrpt::obs::CObservation&);
}  // namespace scanloom
