#include "run/page/internal/PlayerCommand.h"

#include <charconv>
#include <cmath>

namespace scanloom
{
std::optional<PlayerCommand> parsePlayerCommand(const std::string& text)
{
  using Kind = PlayerCommand::Kind;
  if (text == "play") return PlayerCommand{Kind::Play, 0};
  if (text == "pause") return PlayerCommand{Kind::Pause, 0};
  if (text == "step") return PlayerCommand{Kind::Step, 0};
  const std::size_t blank = text.find(' ');
  if (blank == std::string::npos) return std::nullopt;
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + blank + 1, end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value)) return std::nullopt;
  const std::string word = text.substr(0, blank);
  if (word == "speed" && value >= 0.1 && value <= 100) return PlayerCommand{Kind::Speed, value};
  if (word == "seek" && value >= 0) return PlayerCommand{Kind::Seek, value};
  return std::nullopt;
}
}  // namespace scanloom
