/** The packets of a simulated drive, made once for all runs that read them. */
#pragma once
#include "Command.h"
#include "study/PlannedDrive.h"

#include <filesystem>
#include <string>

namespace scanloom
{
/** `scanloom simulate ...` into the folder. */
Command simulateCommand(const PlannedDrive&, const std::filesystem::path& folder);

/** Replaces what is in the folder. @return why there are no packets; empty if all went well. */
std::string simulateDrive(const PlannedDrive&, const std::filesystem::path& folder);

/** What tells how good a trajectory is stays: ground truth, total station, extrinsics. */
void removePackets(const std::filesystem::path& folder);
}  // namespace scanloom
