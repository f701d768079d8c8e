#include "mrpt_bridge/registerClasses.h"

#include "mrpt_bridge/CGenericPointsMap.h"

#include <mrpt/rtti/CObject.h>

namespace scanloom
{
void registerClasses() { mrpt::rtti::registerClass(CLASS_ID(mrpt::maps::CGenericPointsMap)); }
}  // namespace scanloom
