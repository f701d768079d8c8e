#pragma once
#include "mrpt/edit/RawlogEdit.h"
#include "mrpt/observations/Observations.h"

namespace scanloom
{
/**
 * Converts clouds to one class, for tools that read no other; clouds that already are of it stay as they are.
 * CPointsMapXYZI keeps positions (in the body frame) and intensity. A CGenericPointsMap made from another class gets
 * only these two; fields without known values are left out.
 */
RawlogOperation convertClouds(CloudClass);
}  // namespace scanloom
