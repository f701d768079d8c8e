/** Clouds made of points of other clouds, with all fields of any name and the options of the cloud. */
#pragma once
#include "mrpt/observations/CGenericPointsMap.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scanloom
{
/** The points with these indices, in this order, with all fields except `without`. */
mrpt::maps::CGenericPointsMap::Ptr selected(const mrpt::maps::CGenericPointsMap&,
                                            const std::vector<std::uint32_t>& points, const std::string& without = "");

/** The parts (at least one) one after another, with the options of the first. A field that a part lacks is 0 there. */
mrpt::maps::CGenericPointsMap::Ptr joined(const std::vector<mrpt::maps::CGenericPointsMap::Ptr>& parts);

/** The points with keep[i] not 0, of a cloud of any class. Throws std::invalid_argument if the sizes differ. */
mrpt::maps::CPointsMap::Ptr kept(const mrpt::maps::CPointsMap::Ptr&, const std::vector<std::uint8_t>& keep);
}  // namespace scanloom
