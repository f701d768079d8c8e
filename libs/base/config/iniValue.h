#pragma once
#include <string>

namespace scanloom
{
/**
 * Text from data, as it stands behind `key =` of an INI file. Throws std::invalid_argument if it would be read as
 * something else: MRPT's dialect has no quotes, so a line break would begin another key, and `$eval{` a formula.
 */
std::string iniValue(const std::string& text);
}  // namespace scanloom
