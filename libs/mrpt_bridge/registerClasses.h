#pragma once

namespace scanloom
{
/**
 * Tells MRPT's factories of our classes, and of the stock ones that our rawlogs hold. May be called any number of
 * times; the plugin does at load, and everything here that reads a rawlog. A static library needs the call: nothing
 * else refers to the classes, so the linker would leave them out.
 */
void registerClasses();
}  // namespace scanloom
