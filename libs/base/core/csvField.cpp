#include "base/core/csvField.h"

#include "base/core/Text.h"

namespace scanloom
{
std::string csvField(const std::string& text)
{
  const std::string shown = notAFormula(text);
  if (shown.find_first_of(",\"\r\n") == std::string::npos) return shown;
  std::string quoted = "\"";
  for (const char c : shown) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}
}  // namespace scanloom
