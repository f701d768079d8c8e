#pragma once
#include <string>

namespace scanloom
{
/**
 * Text as a field of CSV (RFC 4180), in quotes where it has a comma, a quote or a line break; no formula for a
 * spreadsheet.
 */
std::string csvField(const std::string& text);
}  // namespace scanloom
