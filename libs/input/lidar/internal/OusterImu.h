#pragma once
#include "base/core/Bytes.h"
#include "base/core/ImuSample.h"
#include "input/lidar/internal/OusterLayout.h"

#include <vector>

namespace scanloom
{
/**
 * The samples of an IMU packet of either format in SI units, oldest first. Samples are left out that the sensor marks
 * as invalid, that are not finite, or whose stamp exceeds 62 bits. Throws std::out_of_range if the packet is too short.
 */
std::vector<ImuSample> readOusterImu(Bytes packet, const OusterLayout&);

/** Units of LEGACY packets. */
constexpr double kOusterStandardGravity = 9.80665;  // m/s2 per g
constexpr double kOusterDegree = 3.14159265358979323846 / 180;
}  // namespace scanloom
