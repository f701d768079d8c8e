#pragma once
#include "lab/whole_turns/WholeTurns.h"

#include <filesystem>

namespace scanloom
{
/**
 * Writes `recording.rawlog` into a recording's folder, with the whole turns and the IMU samples of its captures, which
 * are removed. The rawlog's header names no rate of scans: they vary in length. Throws what reading and writing throw.
 */
void replaceByTurns(const std::filesystem::path& folder, TurnGrouping);
}  // namespace scanloom
