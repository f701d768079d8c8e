/** The rig of a folder that `scanloom simulate` wrote: two lidars and an IMU, as in params/dual_os0_recording.ini. */
#pragma once
#include "input/rig/Rig.h"

#include <filesystem>
#include <string>

namespace scanloom
{
/** Its section [lidars], with more keys at its end. */
inline std::string recordedRigSection(const std::filesystem::path& folder, const std::string& more_keys = "")
{
  const std::string f = folder.string();
  return "[lidars]\ndriver = CMultiLidarSensor\nprocess_rate = 100\npcap_input = " + f +
         "/recording.pcap\nextrinsics = " + f + "/extrinsics.txt\nimu_csv = " + f +
         "/imu.csv\nlidar1_name = left\nlidar1_metadata = " + f +
         "/left.json\nlidar2_name = right\nlidar2_metadata = " + f + "/right.json\n" + more_keys;
}

inline RigSettings recordedRigSettings(const std::filesystem::path& folder, const std::string& more_keys = "")
{
  return readRigSettings(Configuration::fromText(recordedRigSection(folder, more_keys), "test.ini"), "lidars");
}
}  // namespace scanloom
