/** Verdicts on the measures, and how to mend what is wrong. */
#pragma once
#include "dataset/Finding.h"
#include "dataset/RigExamination.h"

namespace scanloom
{
/** All of it, lidar by lidar, then the rig's. */
Findings findingsOf(const RigExamination&, const DoctorLimits&);

// The parts of it.
Findings deliveryFindings(const LidarExamination&, const DeliveryLimits&);
Findings clockFindings(const RigExamination&, std::size_t lidar, const ClockLimits&);
Findings imuFindings(const RigExamination&, std::size_t imu, const ImuLimits&);
Findings groundFindings(const RigExamination&, std::size_t lidar, const GeometryLimits&);
Finding poseFinding(const RigExamination&, const PairExamination&, const GeometryLimits&);
Finding jitterFinding(const LidarExamination&, Duration deadline, const DeliveryLimits&);
}  // namespace scanloom
