/** The IMU's mount as text for a person, and as JSON. */
#pragma once
#include "calibration/ImuMountEstimate.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace scanloom
{
/** Whether all is told; else the reason and the remedy are in inWords(). */
bool trusted(const ImuMountEstimate&);

/** Lines about the IMU: its pose with standard deviations, its clock, and what is open. */
std::string inWords(const ImuMountEstimate&);

/** As of a lidar (MountReport.h). */
nlohmann::json toJson(const ImuMountEstimate&);
}  // namespace scanloom
