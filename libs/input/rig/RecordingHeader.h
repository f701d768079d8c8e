/** What a scan does not say of the lidars that it is from; every rawlog begins with it. */
#pragma once
#include "base/core/MountedLidar.h"
#include "base/core/Rigid.h"
#include "base/core/Time.h"

#include <string>
#include <vector>

namespace scanloom
{
struct Rig;

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
  std::string version;                // of the program that wrote the rawlog
  double recorded_rate = 0;           // Hz, of the scans before they were batched again; 0: scan_rate

  /** 0 if the rate is unknown. */
  Duration period() const { return scan_rate > 0 ? fromSeconds(1 / scan_rate) : Duration{0}; }
};

/** Of a lidar without a decoder (live, its sensor has not answered yet) only the name and the pose are known. */
RecordingHeader recordingHeader(const Rig&);

std::vector<MountedLidar> mountedLidars(const std::vector<RecordedLidar>&);

/** Their names, by sensor id. */
std::vector<std::string> lidarNames(const RecordingHeader&);
}  // namespace scanloom
