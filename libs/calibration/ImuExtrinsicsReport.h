/** The IMU's extrinsics as text for a person, and as JSON. */
#pragma once
#include "calibration/ImuExtrinsicsEstimate.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace scanloom
{
/** Whether the drive shows all of it; else the reason and the remedy are in inWords(). */
bool trusted(const ImuExtrinsicsEstimate&);

/** Lines about the IMU: its pose with standard deviations, its clock, and what is open. */
std::string inWords(const ImuExtrinsicsEstimate&);

/** As of a lidar (ExtrinsicsReport.h). */
nlohmann::json toJson(const ImuExtrinsicsEstimate&);
}  // namespace scanloom
