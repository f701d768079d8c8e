/** Parts of texts, and texts as terminals and tables may show them. */
#pragma once
#include <string>
#include <string_view>

namespace scanloom
{
/** Without the blanks, tabulators and ends of lines at both ends. */
std::string_view trimmed(std::string_view);

/** ASCII letters alone. */
std::string lowerCase(std::string_view);

inline bool beginsWith(std::string_view text, std::string_view beginning)
{
  return text.substr(0, beginning.size()) == beginning;
}

inline bool endsWith(std::string_view text, std::string_view end)
{
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

/**
 * Text from a device or a file as a terminal may show it: control characters, marks that change the direction of
 * writing, and bytes that are no UTF-8 become '?'. Otherwise a sensor's model could move the cursor or hide a warning.
 */
std::string printable(const std::string& text);

/** The same, but lines end where they do. */
std::string printableLines(const std::string& text);

/**
 * Text for a column of CSV: after a ' where a spreadsheet would compute it, as it does what begins with = + - or @ and
 * is no number.
 */
std::string notAFormula(const std::string& text);
}  // namespace scanloom
