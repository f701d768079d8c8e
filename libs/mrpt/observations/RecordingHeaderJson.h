/**
 * The first object of each of our rawlogs: a CObservationComment whose text is the RecordingHeader as JSON. Its label
 * is `scanloom`, but is not stored (CommentReadByAll).
 */
#pragma once
#include "input/rig/RecordingHeader.h"

#include <optional>
#include <string>

namespace scanloom
{
/** An empty version becomes this program's. */
std::string toJson(const RecordingHeader&);

/** The JSON with another scan rate, and with the recorded rate if they differ. Poses keep all their digits, because
 * they are not converted to RecordingHeader and back. */
std::string withScanRate(const std::string& header, double scan_rate);

/** Nothing if the text is another program's comment. Throws std::invalid_argument that names the key if the text is a
 * damaged header. */
std::optional<RecordingHeader> recordingHeaderFromJson(const std::string& text);
}  // namespace scanloom
