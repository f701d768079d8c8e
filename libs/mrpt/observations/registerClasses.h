#pragma once

namespace scanloom
{
/**
 * Registers our classes of points with MRPT's factory. May be called any number of times. The plugin calls it when it
 * is loaded, and so does every reader of rawlogs. In a static library the call is needed: the linker leaves out classes
 * that nothing refers to.
 */
void registerClasses();
}  // namespace scanloom
