/** A recording on the command line: files and folders that are recognised by what they hold. */
#pragma once
#include "Options.h"
#include "base/config/Configuration.h"
#include "input/rig/RecordingFiles.h"
#include "warn.h"

#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
struct RecordingArguments
{
  std::vector<std::filesystem::path> paths;
  std::vector<std::filesystem::path> metadata;

  bool given() const { return !paths.empty(); }
};

/** Adds the argument RECORDING and --metadata. @return the argument. */
Option addRecording(CLI::App&, RecordingArguments&);

enum class Clouds
{
  Refused,
  Taken,
};

/** What the arguments name; the messages name files that are not used. @throws UsageError as filesOf() does, for
 * captures together with rawlogs, and for clouds where they are of no use. */
RecordingFiles filesOf(const RecordingArguments&, Clouds = Clouds::Refused, const Messages& = {});

enum class Poses
{
  Needed,
  TakenAsZero,  // where a lidar's pose is not known
};

struct RecordedSensors
{
  bool poses_known = true;   // of all lidars, in a body frame; else their own frames are taken for it
  std::size_t not_used = 0;  // sensors that belong to the recording and are missing in what is read
};

/**
 * Adds the captures: to the lidars that the configuration describes, else with the lidars that are recognised, which
 * the messages name.
 */
RecordedSensors addCaptures(const RecordingFiles&, Configuration&, Poses = Poses::Needed, const Messages& = {});

/** A name for results beside the recording: drive.pcap.gz and "_slam" give drive_slam, a folder dense/ gives
 * dense_slam. */
std::filesystem::path besideRecording(const RecordingArguments&, const std::string& ending);
}  // namespace scanloom
