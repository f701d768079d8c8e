#include "mrpt/observations/registerClasses.h"

#include "mrpt/observations/CGenericPointsMap.h"

#include <mrpt/rtti/CObject.h>

namespace scanloom
{
void registerClasses() { mrpt::rtti::registerClass(CLASS_ID(mrpt::maps::CGenericPointsMap)); }
}  // namespace scanloom
