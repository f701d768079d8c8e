/** Keys of earlier versions, for a message about files that still hold them. */
#pragma once
#include <string_view>

namespace scanloom
{
/** What to do about a key that an earlier version had, that of a list without its prefix lidarN_; empty: none had it.
 */
std::string_view adviceOnRemoved(std::string_view section, std::string_view key);

/** The same of a section. */
std::string_view adviceOnRemoved(std::string_view section);
}  // namespace scanloom
