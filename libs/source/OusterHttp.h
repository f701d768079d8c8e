/** What an Ouster sensor tells over HTTP, firmware 2.1 and newer ("HTTP API" of the maker's firmware manual). */
#pragma once
#include "source/SensorHttp.h"

#include <string>

namespace scanloom
{
/**
 * The sensor's metadata as parseOusterMetadata reads it: /api/v1/sensor/metadata, or put together from its sections
 * where the firmware is too old for that; the configuration in use is always in it. Asks only, changes nothing.
 * Throws SensorHttpError, also for a sensor that is not RUNNING and for metadata that the parser refuses.
 */
std::string fetchOusterMetadata(SensorHttp&);
std::string fetchOusterMetadata(const SensorAddress&, const SensorHttpLimits& = {});

/** "2.3.0", from /api/v1/system/firmware. Throws SensorHttpError; WrongFirmware before 2.0. */
std::string fetchOusterFirmware(SensorHttp&);

/** "RUNNING", "INITIALIZING", "STANDBY", ... as sensor_info says it. Throws SensorHttpError. */
std::string fetchOusterStatus(SensorHttp&);

/** The JSON object of the configuration in use. Throws SensorHttpError. */
std::string fetchOusterConfig(SensorHttp&);

/**
 * Lets the sensor send its packets to `destination` (udp_dest) until it is switched off: the only function that writes
 * to a sensor. One that sends there already is left alone; any other starts anew, which takes seconds and changes its
 * init id. True if it was written to. Throws SensorHttpError, also for a sensor that is not RUNNING.
 */
bool setOusterDestination(SensorHttp&, const IpAddress& destination);
}  // namespace scanloom
