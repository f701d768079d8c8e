#pragma once
#include "base/core/Time.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>

namespace scanloom
{
/** Longest interval between two IMU samples over which readings are interpolated. */
inline constexpr Duration kWidestImuGap = 100ms;

/** Mean reading of a gyroscope while the machine stands still. */
struct GyroBias
{
  Timestamp until;       // end of the standstill
  Eigen::Vector3d bias;  // rad/s
};

/**
 * Searches the rawlog for the first standstill (StandstillOptions) of the IMU with this label; none if it never rests.
 * Throws UsageError with the nearest label if the rawlog has no such IMU.
 */
std::optional<GyroBias> gyroBiasIn(const std::filesystem::path& rawlog, const std::string& label);
}  // namespace scanloom
