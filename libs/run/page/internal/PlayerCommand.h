#pragma once
#include <optional>
#include <string>

namespace scanloom
{
/** What a page asks of a player. */
struct PlayerCommand
{
  enum class Kind
  {
    Play,
    Pause,
    Step,   // one scan further, then pause
    Speed,  // value: times real time
    Seek    // value: s after the start of the recording
  };
  Kind kind = Kind::Play;
  double value = 0;
};

/** "play", "pause", "step", "speed 0.1" to "speed 100", "seek 0" and more; nothing for any other text. */
std::optional<PlayerCommand> parsePlayerCommand(const std::string&);
}  // namespace scanloom
