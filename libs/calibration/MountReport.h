/** Mounts as text for a person, and as JSON. */
#pragma once
#include "calibration/MountEstimate.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace scanloom
{
/** Whether all that was asked for is told; else the reason and the remedy are in inWords(). */
bool trusted(const MountEstimate&);

/** The key of the configuration that is added to the lidar's stamps (s), and its present value. */
struct TimeOffset
{
  std::string key = "time_offset";
  double value = 0;
};

/** Lines about `lidar`: its pose with standard deviations, how well it fits, and what is open. */
std::string inWords(const std::string& lidar, const std::string& reference, const MountEstimate&,
                    const TimeOffset& = {});

/** Poses as in extrinsics files; standard deviations in m, deg and s. */
nlohmann::json toJson(const std::string& lidar, const MountEstimate&);
}  // namespace scanloom
