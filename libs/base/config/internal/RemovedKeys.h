/** Keys of earlier versions, for a message about files that still hold them. */
#pragma once
#include <string_view>

namespace scanloom
{
/** Whether an earlier version had this key; that of a list without its prefix lidarN_. */
bool isConstantNow(std::string_view section, std::string_view key);

/** The same of all keys of a section. */
bool isConstantNow(std::string_view section);
}  // namespace scanloom
