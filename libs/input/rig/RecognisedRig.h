/** From the files of a recording to the configuration that reads them. */
#pragma once
#include "input/rig/RecordingFiles.h"

#include <string>
#include <vector>

namespace scanloom
{
/** The section of the lidars in RecognisedRig::ini. */
inline constexpr const char* kRecognisedSection = "lidars";

struct RecognisedRig
{
  std::string ini;                         // a section [lidars] with a comment for each lidar
  std::vector<std::string> found;          // what was recognised, a line each
  std::vector<std::string> notes;          // what was left out, or must be filled in, and why
  std::vector<std::string> lost;           // of the notes, those of sensors of the rig that cannot be used
  std::vector<std::string> unknown_poses;  // keys of lidars whose pose must be filled in: "lidar2_pose"
  bool poses_from_bag = false;             // by its static transforms, as there is no extrinsics file
  bool poses_known = false;                // of all lidars, in a body frame that is not just a lidar's own
};

/**
 * The rig whose packets the captures hold: metadata, ports, names, poses, IMU. A lidar has the name of its metadata
 * file and the pose T_body_<name> of the extrinsics file; a key whose value is not known is a comment. Relative names
 * of files are written relative to `ini_folder`, where the INI will be read. Throws UsageError if there is no lidar,
 * several metadata fit one, or several IMU or extrinsics files were given, and what reading the files throws.
 */
RecognisedRig recogniseRig(const RecordingFiles&, const std::filesystem::path& ini_folder = ".");
}  // namespace scanloom
