#pragma once
#include "dataset/RawlogEdit.h"
#include "mrpt_bridge/Observations.h"

namespace scanloom
{
/**
 * Clouds of one class, for tools that read no other; those that are of it already stay as they are. CPointsMapXYZI
 * keeps positions (in the body frame) and intensity. A CGenericPointsMap made of another class has just these: what was
 * never known is no field of zeros.
 */
RawlogOperation convertClouds(CloudClass);
}  // namespace scanloom
