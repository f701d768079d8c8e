#include "base/config/MrptMessage.h"

#include "base/core/Text.h"

#include <sstream>
#include <string_view>

namespace scanloom
{
std::string messageIn(const std::string& what)
{
  constexpr std::string_view kLabel = "Message:";
  const auto label = what.find(kLabel);
  std::istringstream lines(label == std::string::npos ? what : what.substr(label + kLabel.size()));
  for (std::string line; std::getline(lines, line);)
    if (const std::string_view text = trimmed(line); !text.empty() && text.substr(0, 2) != "==")
      return std::string(text);
  return "failed without a message";
}
}  // namespace scanloom
