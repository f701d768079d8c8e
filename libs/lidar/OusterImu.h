#pragma once
#include "core/Bytes.h"
#include "core/ImuSample.h"
#include "lidar/OusterLayout.h"

#include <vector>

namespace scanloom
{
/**
 * The samples of an IMU packet of either format in SI units, oldest first. Left out: samples that the sensor marks
 * invalid, readings that are no finite numbers, stamps beyond 62 bits.
 * Throws std::out_of_range on a packet shorter than the layout's.
 */
std::vector<ImuSample> readOusterImu(Bytes packet, const OusterLayout&);

/** LEGACY packets count in multiples of these. */
constexpr double kOusterStandardGravity = 9.80665;  // m/s2 per g
constexpr double kOusterDegree = 3.14159265358979323846 / 180;
}  // namespace scanloom
