/** Conversion between the text of a value and a member of an options struct. */
#pragma once
#include "base/core/Field.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace scanloom
{
/** A finite decimal number and nothing else (MRPT's atof() would take "5 apples" for 5, and "apples" for 0). */
std::optional<double> parseNumber(std::string_view);

/** `> 0`, `between 0 and 1`, `> 0 and <= 5`; empty without bounds. */
std::string toString(const Bounds&);

/**
 * Sets the member if the text is a value of its type within the field's bounds. Otherwise the member keeps its value,
 * and the result says what the text must be ("must be > 0"). Numbers of no meaning, such as 1e300, are refused whatever
 * the bounds. Booleans are true, false, yes, no, 1 or 0 without regard
 * to case, as in MRPT.
 */
std::optional<std::string> assign(bool&, std::string_view text, const Field&);
std::optional<std::string> assign(int&, std::string_view text, const Field&);
std::optional<std::string> assign(double&, std::string_view text, const Field&);
std::optional<std::string> assign(std::string&, std::string_view text, const Field&);

/** PathsFrom of a text that is one path. */
std::string pathFrom(const std::string& text, const std::filesystem::path& folder);

/** The text that assign() turns into the same value again. */
std::string toText(bool);
std::string toText(int);
std::string toText(double);
std::string toText(const std::string&);

const char* typeName(bool);
const char* typeName(int);
const char* typeName(double);
const char* typeName(const std::string&);
}  // namespace scanloom
