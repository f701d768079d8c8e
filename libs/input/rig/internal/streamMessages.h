/** What a person reads of streams that no metadata fit, or several. */
#pragma once
#include "input/rig/FoundLidars.h"

#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
/** Throws UsageError: the stream's packets fit each of these candidates (indices). */
[[noreturn]] void refuseSeveral(const SampledStream&, const std::vector<std::size_t>& fitting,
                                const std::vector<MetadataCandidate>&);

/** Throws UsageError: no stream is a lidar's; with the reason for each candidate, and what to write for the streams. */
[[noreturn]] void refuseNone(const std::vector<SampledStream>&, const std::vector<MetadataCandidate>&,
                             const std::vector<std::filesystem::path>& captures);

/** A note: the stream is used by no lidar, and what would make it one, or which of `unheard` names its port. */
std::string leftOut(const SampledStream&, const std::vector<MetadataCandidate>& unheard);
}  // namespace scanloom
