/** Simulates a drive once for all runs that read its packets. */
#pragma once
#include "lab/study/PlannedDrive.h"
#include "lab/study/internal/Command.h"

#include <filesystem>
#include <string>

namespace scanloom
{
/** `scanloom simulate ...` into the folder. */
Command simulateCommand(const PlannedDrive&, const std::filesystem::path& folder);

/** Replaces the folder. @return why the simulation failed; empty if it did not. */
std::string simulateDrive(const PlannedDrive&, const std::filesystem::path& folder);

/** Removes packets and IMU; ground truth, total station and extrinsics stay, since evaluation needs them. What cannot
 * be removed stays, too. */
void removePackets(const std::filesystem::path& folder);
}  // namespace scanloom
