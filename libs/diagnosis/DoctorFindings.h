/** Verdicts on the measures, with remedies. */
#pragma once
#include "base/core/Finding.h"
#include "diagnosis/internal/RigExamination.h"

namespace scanloom
{
/** Findings on each lidar, then on each IMU, then on the whole rig. */
Findings findingsOf(const RigExamination&, const DoctorLimits&);

// Its parts.
Findings deliveryFindings(const LidarExamination&, const DeliveryLimits&);
Findings clockFindings(const RigExamination&, std::size_t lidar, const ClockLimits&);
Findings imuFindings(const RigExamination&, std::size_t imu, const ImuLimits&);
Findings groundFindings(const RigExamination&, std::size_t lidar, const GeometryLimits&);
Finding jitterFinding(const LidarExamination&, Duration deadline, const DeliveryLimits&);
}  // namespace scanloom
