/** Writes IMU samples, stamps of clouds and poses of a rawlog as text. */
#pragma once
#include "base/core/Rigid.h"
#include "mrpt/edit/RawlogEdit.h"

#include <filesystem>
#include <optional>

namespace scanloom
{
/**
 * `<folder>/<label>.csv` for each IMU in the layout of EuRoC, and `<folder>/clouds.csv`: stamp in ns, label and number
 * of points of each cloud. Throws std::runtime_error if something cannot be written.
 */
RawlogOperation exportCsv(const std::filesystem::path& folder);

/**
 * Poses of the robot (CObservationRobotPose, CObservationOdometry) as a TUM file. Throws std::runtime_error if stamps
 * do not rise, and at the end of input if there were no poses or poses of more than one label.
 */
RawlogOperation exportTum(const std::filesystem::path& file);

/** Of CObservationRobotPose and CObservationOdometry. */
std::optional<Rigid> robotPoseIn(const mrpt::obs::CObservation&);
}  // namespace scanloom
