#include "mrpt_bridge/registerClasses.h"

#include "mrpt_bridge/CGenericPointsMap.h"
#include "mrpt_bridge/CMultiLidarSensor.h"

namespace scanloom
{
void registerClasses()
{
  mrpt::rtti::registerClass(CLASS_ID(mrpt::maps::CGenericPointsMap));
  CMultiLidarSensor::doRegister();
}
}  // namespace scanloom
