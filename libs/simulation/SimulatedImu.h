#pragma once
#include "core/Field.h"
#include "core/ImuSample.h"
#include "imu/Preintegration.h"
#include "simulation/Drive.h"
#include "simulation/Random.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
/** What an IMU adds to the truth. */
struct ImuErrors
{
  ImuNoise noise;
  ImuBias bias;  // at the start; walks from there by the noise's random walks
};

/** What an ideal IMU at body_T_imu measures: turn rate and specific force, in its own frame. */
ImuSample idealImuSample(const Motion&, const Rigid& body_T_imu, Timestamp);

/** Where a recording lies in time. */
struct RecordingSpan
{
  Timestamp start;      // t = 0 of the drive
  double duration = 0;  // s

  double secondsAt(Timestamp stamp) const { return seconds(stamp - start); }
};

/** Samples every `period` from `first` on within the span; `stream` chooses the random numbers. */
std::vector<ImuSample> simulateImu(const Drive&, const RecordingSpan&, const Rigid& body_T_imu, Timestamp first,
                                   Duration period, const ImuErrors&, std::uint64_t seed, RandomStream stream);
}  // namespace scanloom
