#pragma once
#include "source/RigInput.h"

#include <filesystem>
#include <functional>

namespace scanloom
{
/** Asked after each observation with the share of the captures that was read; false stops, keeping what there is. */
using KeepBatching = std::function<bool(double)>;

/**
 * The captures of a rig through the batcher into a rawlog: what `scanloom record` makes of them, and live of the same
 * packets. Throws what openRig and RawlogWriter throw.
 */
RigAccount rawlogFromCaptures(const Rig&, const DriverOptions&, const std::filesystem::path& output,
                              const KeepBatching&);
}  // namespace scanloom
