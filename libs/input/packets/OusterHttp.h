/** The HTTP interface of Ouster sensors, firmware 2.1 and newer ("HTTP API" of the maker's firmware manual). */
#pragma once
#include "input/packets/SensorHttp.h"

#include <string>

namespace scanloom
{
/**
 * The sensor's metadata as parseOusterMetadata reads them, with the configuration in use: /api/v1/sensor/metadata, or
 * its sections from older firmware. Changes nothing in the sensor. Throws SensorHttpError, also if the sensor is not
 * RUNNING or the parser refuses its metadata.
 */
std::string fetchOusterMetadata(SensorHttp&);

/**
 * Makes the sensor send its packets to `destination` (udp_dest) until it is switched off. If it does so already,
 * nothing is written and the result is false; otherwise it restarts, which takes seconds and changes its init id. This
 * is the only function that writes to a sensor. Throws SensorHttpError, also if the sensor is not RUNNING.
 */
bool setOusterDestination(SensorHttp&, const IpAddress& destination);
}  // namespace scanloom
