#include "base/config/Values.h"

#include "base/config/Names.h"
#include "base/core/Text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace scanloom
{
namespace
{
bool within(double value, const Bounds& bounds)
{
  const bool high_enough = bounds.lowest_excluded ? value > bounds.lowest : value >= bounds.lowest;
  return high_enough && value <= bounds.highest;
}

/** Beyond these a number has no meaning in any unit of ours: 1e9 s are 30 years, 1e-12 m is less than an atom. */
constexpr double kSmallest = 1e-12, kLargest = 1e9;

bool isOfThisWorld(double value) { return value == 0 || (std::abs(value) >= kSmallest && std::abs(value) <= kLargest); }

std::string mustBe(const Bounds& bounds) { return "must be " + toString(bounds); }

/** Often a value is wrong because of a trailing comment with `#` or `;`, which MRPT allows at the start of a line only.
 */
std::string mustBe(const char* what, std::string_view text)
{
  const bool has_comment = text.find_first_of("#;") != std::string_view::npos;
  return fmt::format("must be {}{}", what, has_comment ? " (a comment behind a value begins with ' //')" : "");
}
}  // namespace

std::optional<double> parseNumber(std::string_view text)
{
  text = trimmed(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::string toString(const Bounds& bounds)
{
  const bool bounded_below = std::isfinite(bounds.lowest);
  const bool bounded_above = std::isfinite(bounds.highest);
  if (bounded_below && bounded_above && !bounds.lowest_excluded)
    return fmt::format("between {} and {}", bounds.lowest, bounds.highest);

  std::string text;
  if (bounded_below) text = fmt::format("{} {}", bounds.lowest_excluded ? ">" : ">=", bounds.lowest);
  if (bounded_above) text += fmt::format("{}<= {}", bounded_below ? " and " : "", bounds.highest);
  return text;
}

std::optional<std::string> assign(bool& member, std::string_view text, const Field&)
{
  for (const char* yes : {"true", "yes", "1"})
    if (sameName(text, yes)) return member = true, std::nullopt;
  for (const char* no : {"false", "no", "0"})
    if (sameName(text, no)) return member = false, std::nullopt;
  return mustBe("true, false, yes, no, 1 or 0", text);
}

std::optional<std::string> assign(int& member, std::string_view text, const Field& field)
{
  const auto number = parseNumber(text);  // $eval{2*5} is 1.000000e+01
  const bool whole = number && std::floor(*number) == *number && std::abs(*number) <= std::numeric_limits<int>::max();
  if (!whole) return mustBe("a whole number", text);
  if (!within(*number, field.bounds)) return mustBe(field.bounds);
  member = static_cast<int>(*number);
  return std::nullopt;
}

std::optional<std::string> assign(double& member, std::string_view text, const Field& field)
{
  const auto number = parseNumber(text);
  if (!number) return mustBe("a number", text);
  if (!within(*number, field.bounds)) return mustBe(field.bounds);
  if (!isOfThisWorld(*number))
    return fmt::format("must be 0 or a number whose size is between {} and {}", kSmallest, kLargest);
  member = *number;
  return std::nullopt;
}

std::optional<std::string> assign(std::string& member, std::string_view text, const Field&)
{
  member = text;
  return std::nullopt;
}

std::string pathFrom(const std::string& text, const std::filesystem::path& folder)
{
  return (folder / text).lexically_normal().string();
}

std::string toText(bool value) { return value ? "true" : "false"; }
std::string toText(int value) { return fmt::format("{}", value); }
std::string toText(double value) { return fmt::format("{}", value); }
std::string toText(const std::string& value) { return value; }

const char* typeName(bool) { return "bool"; }
const char* typeName(int) { return "int"; }
const char* typeName(double) { return "double"; }
const char* typeName(const std::string&) { return "text"; }
}  // namespace scanloom
