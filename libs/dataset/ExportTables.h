/** What is no cloud, as text. */
#pragma once
#include "dataset/RawlogEdit.h"

#include <filesystem>

namespace scanloom
{
/**
 * `<folder>/<label>.csv` for each IMU in the layout of EuRoC, and `<folder>/clouds.csv`: stamp in ns, label and number
 * of points of each cloud. Passes nothing on. Throws std::runtime_error if something cannot be written.
 */
RawlogOperation exportCsv(const std::filesystem::path& folder);

/**
 * Poses of the robot (CObservationRobotPose, CObservationOdometry) as a TUM file. At the end of input throws
 * std::runtime_error if there were none or of more than one label, on the way if stamps do not rise.
 */
RawlogOperation exportTum(const std::filesystem::path& file);
}  // namespace scanloom
