/** Points of a cloud with all their fields, whatever they are called, and the cloud's own options. */
#pragma once
#include "mrpt_bridge/CGenericPointsMap.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scanloom
{
/** These points in this order; all fields but `without`. */
mrpt::maps::CGenericPointsMap::Ptr selected(const mrpt::maps::CGenericPointsMap&,
                                            const std::vector<std::uint32_t>& points, const std::string& without = "");

/** One after the other, at least one; options are those of the first. Where a part lacks a field it is 0. */
mrpt::maps::CGenericPointsMap::Ptr joined(const std::vector<mrpt::maps::CGenericPointsMap::Ptr>& parts);

/** The points with keep[i] not 0, of a cloud of any class. Throws std::invalid_argument if the sizes differ. */
mrpt::maps::CPointsMap::Ptr kept(const mrpt::maps::CPointsMap::Ptr&, const std::vector<std::uint8_t>& keep);
}  // namespace scanloom
