/** What a gyroscope of a rawlog reads while the machine stands still. */
#pragma once
#include "core/Time.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>

namespace scanloom
{
/** Between two samples of an IMU that is in use; where it is longer, readings are not interpolated. */
inline constexpr Duration kWidestImuGap = 100ms;

struct GyroBias
{
  Timestamp until;       // the standstill's end
  Eigen::Vector3d bias;  // rad/s, its mean rate
};

/**
 * Of the first standstill (StandstillOptions) in the rawlog, which is read up to there; nothing if the IMU with this
 * label is never at rest. Throws UsageError with the nearest label if the rawlog has none such.
 */
std::optional<GyroBias> gyroBiasIn(const std::filesystem::path& rawlog, const std::string& label);
}  // namespace scanloom
