#pragma once
#include <charconv>
#include <optional>
#include <string_view>

namespace scanloom
{
/** The number that the text is, from its first to its last character; none if it is no number of this type. */
template <typename Number>
std::optional<Number> parseWhole(std::string_view text)
{
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}
}  // namespace scanloom
