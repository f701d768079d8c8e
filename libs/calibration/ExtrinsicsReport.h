/** Extrinsics as text for a person, and as JSON. */
#pragma once
#include "calibration/ExtrinsicsEstimate.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace scanloom
{
/** Whether the drive shows all that was asked for; else the reason and the remedy are in inWords(). */
bool trusted(const ExtrinsicsEstimate&);

/** The key of the configuration that is added to the lidar's stamps (s), and its present value. */
struct TimeOffset
{
  std::string key = "time_offset";
  double value = 0;
};

/** Lines about `lidar`: its pose with standard deviations, how well it fits, and what is open. */
std::string inWords(const std::string& lidar, const std::string& reference, const ExtrinsicsEstimate&,
                    const TimeOffset& = {});

/** Poses as in extrinsics files; standard deviations in m, deg and s. */
nlohmann::json toJson(const std::string& lidar, const ExtrinsicsEstimate&);
}  // namespace scanloom
