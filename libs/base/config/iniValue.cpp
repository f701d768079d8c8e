#include "base/config/iniValue.h"

#include "base/config/internal/IniFile.h"
#include "base/core/ConfigError.h"
#include "base/core/Text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace scanloom
{
namespace
{
/** Looked for before it is read: a formula is not evaluated to see what it is. */
bool holdsFormula(const std::string& text)
{
  constexpr std::array kOpenings{"${", "$env{", "$eval{"};
  return std::any_of(kOpenings.begin(), kOpenings.end(),
                     [&](const char* opening) { return text.find(opening) != std::string::npos; });
}

/** With a key behind it, which a `\` at the end would join. */
bool isReadAsItself(const std::string& text)
try
{
  const std::vector<IniEntry> entries = parseIni(fmt::format("[section]\nkey = {}\nnext =\n", text), "");
  return entries.size() == 2 && entries.front().value == text;
}
catch (const ConfigError&)
{
  return false;
}
}  // namespace

std::string iniValue(const std::string& text)
{
  if (holdsFormula(text) || !isReadAsItself(text))
    throw std::invalid_argument(
        fmt::format("'{}' cannot stand in a configuration file, which would read something else", printable(text)));
  return text;
}
}  // namespace scanloom
