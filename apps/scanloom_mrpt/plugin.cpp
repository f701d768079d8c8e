/** libscanloom_mrpt.so: `rawlog-grabber -p`, `rawlog-edit -p` and `RawLogViewer -l` learn our classes by loading it. */
#include "mrpt/observations/registerClasses.h"
#include "mrpt/sensors/CMultiLidarSensor.h"

#include <mrpt/core/initializer.h>

MRPT_INITIALIZER(registerScanloom)
{
  scanloom::registerClasses();
  scanloom::CMultiLidarSensor::doRegister();
}
