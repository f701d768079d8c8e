#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
struct UnusedFile
{
  std::filesystem::path path;
  std::string why;
  bool has_data = false;  // that could have been meant for the recording; else it is a text, a picture, ...
  bool is_imu = false;
};

/** The files of one recording, by what they are good for; each list in the order of names. */
struct RecordingFiles
{
  using Paths = std::vector<std::filesystem::path>;

  Paths captures, rawlogs;
  Paths clouds;                    // only where there are neither: else they are results beside a recording
  Paths metadata;                  // of lidars
  Paths imus, extrinsics;          // of the body
  std::vector<UnusedFile> unused;  // of the given folders, but for hidden ones and those that go with a bag

  bool empty() const { return captures.empty() && rawlogs.empty() && clouds.empty(); }
};

/**
 * The given files, and all files of the given folders (not of folders within). Beside captures and
 * rawlogs clouds are taken for results; metadata, poses and IMU are used with captures alone. Metadata, IMU and poses
 * that are not among them are looked for beside the first of the given files. Throws UsageError for a name that is no
 * file or folder, for a given file of no known kind, and if there is no recording among them.
 */
RecordingFiles filesOf(const std::vector<std::filesystem::path>& given);
}  // namespace scanloom
