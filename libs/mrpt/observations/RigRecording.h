#pragma once
#include "input/rig/RigOptions.h"
#include "input/rig/SensorInput.h"

#include <cstdint>
#include <functional>

namespace scanloom
{
class RawlogWriter;

struct Recorded
{
  std::uint64_t scans = 0, imu_samples = 0, marks = 0;
};

/** Asked after each event, and every 100 ms while none comes. False ends the input; what was received is still written.
 */
using KeepRecording = std::function<bool(const Recorded&)>;

/** Writes all scans, IMU samples and marks of the input; the caller closes the rawlog. Throws what both of them throw.
 */
Recorded recordRig(SensorInput&, const DriverOptions&, RawlogWriter&, const KeepRecording&);
}  // namespace scanloom
