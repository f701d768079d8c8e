/** The header of a rawlog as operations use it: which lidars there are, and which label belongs to which lidar. */
#pragma once
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"

#include <filesystem>
#include <optional>
#include <string>

namespace scanloom
{
/** Reads the file's first object; none if that is no header. Throws std::runtime_error if the file can't be opened. */
std::optional<RecordingHeader> headerOf(const std::filesystem::path&);

/** For operations that must know the lidars. Throws std::invalid_argument with a remedy if there is no header. */
const RecordingHeader& required(const std::optional<RecordingHeader>&);

/** A comment like the given one that holds another header. */
ObservationPtr withHeader(const mrpt::obs::CObservation& comment, const RecordingHeader&);

/** The lidar's index in the header. Throws UsageError with the nearest name if there is no such lidar. */
std::size_t lidarNamed(const std::string& name, const RecordingHeader&);

/** Label of one lidar's part of a cloud: `lidar`, `left` -> `lidar_left`; `lidar_slice`, `left` -> `lidar_left_slice`.
 */
std::string labelOfPart(const std::string& whole, const std::string& lidar);

struct LidarPart
{
  std::string whole;  // label of the cloud of all lidars
  std::size_t lidar;  // index in the header
};
/** The inverse of labelOfPart(); none if the label ends in no lidar's name. */
std::optional<LidarPart> partOf(const std::string& label, const RecordingHeader&);
}  // namespace scanloom
