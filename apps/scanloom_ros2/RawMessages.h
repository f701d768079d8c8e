/** Messages as Cyclone DDS carries them, without a look into them. */
#pragma once
#include "base/core/Bytes.h"

#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>

#include <cstdint>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * A type of which Cyclone knows the name alone. Its messages are the bytes that MessageWriter wrote or MessageReader
 * will check: one serialisation for files and network, and no code generated from IDL. Types of one name are the same
 * (ROS 2's own DDS layer does so, too, hence it offers no XTypes that could contradict those of others).
 * The caller has one reference to it.
 */
ddsi_sertype* rawType(const std::string& dds_type);

/** With one reference. Throws std::bad_alloc. */
ddsi_serdata* rawMessage(const ddsi_sertype*, std::vector<std::uint8_t> bytes);

/** With its encapsulation; empty for a message that tells only that a publisher has gone. Valid as long as the message.
 */
Bytes bytesOf(const ddsi_serdata*);
}  // namespace scanloom
