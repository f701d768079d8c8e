#include "input/rig/InputDisplay.h"

namespace scanloom
{
InputDisplay::InputDisplay(const std::string& verb, SensorInput& input, std::uint64_t total, const std::string& unit)
  : input_(input), total_(total)
{
  replay_.emplace(verb, total, total > 0 ? unit : "scans");
}

InputDisplay::InputDisplay(const std::string& verb, SensorInput& input) : input_(input) { live_.emplace(verb); }

InputDisplay::~InputDisplay()
{
  if (!replay_) return;
  for (const std::string& warning : warnings_.unsaid()) replay_->say("warning: " + warning);
}

void InputDisplay::update(double share, std::uint64_t scans, const Work& work, Clock::time_point now)
{
  constexpr auto kLookEvery = 200ms;  // a file's reader is asked for its warnings between two of its events
  if (live_) return live_->update(input_, work, now);
  if (now - looked_ > kLookEvery)
  {
    for (const std::string& warning : input_.takeWarnings()) warn(warning, now);
    looked_ = now;
  }
  replay_->update(total_ > 0 ? static_cast<std::uint64_t>(share * static_cast<double>(total_)) : scans);
}

void InputDisplay::say(const std::string& line)
{
  if (live_)
    live_->warn(line);
  else
    replay_->say(line);
}

void InputDisplay::warn(const std::string& warning, Clock::time_point now)
{
  if (live_) return live_->warn(warning, now);
  if (const auto said = warnings_.toSay(warning, now)) replay_->say("warning: " + *said);
}
}  // namespace scanloom
