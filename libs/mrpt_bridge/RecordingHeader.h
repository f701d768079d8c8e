/**
 * What a rawlog's clouds can't say of the lidars behind them: the first object of each of our rawlogs is a
 * CObservationComment whose text is this as JSON (label `scanloom`, but MRPT before 2.15 does not store a comment's
 * label).
 */
#pragma once
#include "core/MountedLidar.h"
#include "core/Time.h"
#include "lidar/PacketDecoder.h"

#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct RecordedLidar
{
  std::string name;  // as the configuration calls it: "left"
  std::string serial;
  std::string model;
  Rigid body_T_sensor;
  int beams = 0;
  int columns = 0;    // of a full turn
  std::string clock;  // the sensor's name for its time source
};

struct RecordingHeader
{
  std::vector<RecordedLidar> lidars;  // the index is the points' sensor_id
  double scan_rate = 0;               // Hz
  std::string version;                // of the program that wrote the rawlog; toJson() fills an empty one in
  double recorded_rate = 0;           // Hz, of the scans before they were batched anew; 0: scan_rate

  /** 0 if the rate is unknown. */
  Duration period() const { return scan_rate > 0 ? fromSeconds(1 / scan_rate) : Duration{0}; }
};

RecordedLidar recordedLidar(const std::string& name, const LidarDescription&);

std::vector<MountedLidar> mountedLidars(const std::vector<RecordedLidar>&);

std::string toJson(const RecordingHeader&);

/** A header's text with another rate and the recorded one, if they differ; poses keep all their digits, which parsing
 * them does not promise. */
std::string withScanRate(const std::string& header, double scan_rate);

/** Nothing if the text is not a header at all (somebody else's comment); throws std::invalid_argument naming the key
 *  if it is one of ours but damaged. */
std::optional<RecordingHeader> recordingHeaderFromJson(const std::string& text);
}  // namespace scanloom
