/** Verdicts on the measures, with remedies. */
#pragma once
#include "base/core/Finding.h"
#include "diagnosis/internal/RigExamination.h"

namespace scanloom
{
/** Findings on each lidar, then on each IMU, then on the whole rig. */
Findings findingsOf(const RigExamination&);

// Its parts.
Findings deliveryFindings(const LidarExamination&);
Findings clockFindings(const RigExamination&, std::size_t lidar);
Findings imuFindings(const RigExamination&, std::size_t imu);
Findings groundFindings(const RigExamination&, std::size_t lidar);
Finding jitterFinding(const LidarExamination&, Duration deadline);
}  // namespace scanloom
