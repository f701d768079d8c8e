#include "base/core/Text.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>

namespace scanloom
{
namespace
{
struct Character
{
  char32_t code = 0;
  std::size_t bytes = 0;  // 0: no UTF-8
};

Character firstOf(std::string_view text)
{
  const auto lead = static_cast<std::uint8_t>(text.front());
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {};
  char32_t code = lead & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i)
  {
    const auto next = static_cast<std::uint8_t>(text[i]);
    if ((next & 0xC0) != 0x80) return {};
    code = code << 6 | (next & 0x3Fu);
  }
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  return code >= kLeast[bytes] && code <= 0x10FFFF ? Character{code, bytes} : Character{};
}

bool controlsTheTerminal(char32_t code)
{
  const bool is_control = code < 0x20 || (code >= 0x7F && code < 0xA0);
  const bool turns_direction =
      code == 0x200E || code == 0x200F || (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
  return is_control || turns_direction;
}
}  // namespace

std::string_view trimmed(std::string_view text)
{
  constexpr std::string_view kBlanks = " \t\r\n";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string lowerCase(std::string_view text)
{
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

std::string printable(const std::string& text)
{
  std::string shown;
  for (std::string_view rest = text; !rest.empty();)
  {
    const Character character = firstOf(rest);
    const std::size_t bytes = character.bytes > 0 ? character.bytes : 1;
    if (character.bytes == 0 || controlsTheTerminal(character.code))
      shown += '?';
    else
      shown += rest.substr(0, bytes);
    rest.remove_prefix(bytes);
  }
  return shown;
}

std::string printableLines(const std::string& text)
{
  std::string shown;
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = text.find('\n', begin)) != text.npos; begin = end + 1)
    shown += printable(text.substr(begin, end - begin)) + '\n';
  return shown + printable(text.substr(begin));
}

std::string notAFormula(const std::string& text)
{
  if (text.empty() || std::string("=+-@\t\r").find(text.front()) == std::string::npos) return text;
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  const bool is_number = end == text.c_str() + text.size();
  return is_number ? text : "'" + text;
}
}  // namespace scanloom
