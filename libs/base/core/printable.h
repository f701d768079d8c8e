#pragma once
#include <string>

namespace scanloom
{
/**
 * Text from a device or a file as a terminal may show it: control characters, marks that change the direction of
 * writing, and bytes that are no UTF-8 become '?'. Otherwise a sensor's model could move the cursor or hide a warning.
 */
std::string printable(const std::string& text);

/**
 * Text for a column of CSV: after a ' where a spreadsheet would compute it, as it does what begins with = + - or @ and
 * is no number.
 */
std::string notAFormula(const std::string& text);
}  // namespace scanloom
