#include "run/page/WatchedInput.h"

namespace scanloom
{
std::optional<SensorEvent> WatchedInput::next(Duration patience)
{
  // setup() copies all that is known of the lidars: live it becomes more, but not with every event.
  constexpr auto kReadAgainAfter = 1s;
  std::optional<SensorEvent> event;
  if (auto mark = feed_.takeMark())
    event = *std::move(mark);
  else
    event = input_.next(patience);
  const auto now = LiveFeed::Clock::now();
  if (header_.lidars.empty() || now - header_read_ > kReadAgainAfter)
  {
    header_ = input_.setup().header;
    header_read_ = now;
  }
  if (!event) return event;
  if (const auto* scan = std::get_if<Scan>(&*event)) feed_.add(*scan, header_);
  if (const auto* sample = std::get_if<SensorImu>(&*event)) feed_.add(*sample, header_);
  if (const auto* mark = std::get_if<EventMark>(&*event)) feed_.add(*mark);
  return event;
}

std::vector<std::string> WatchedInput::takeWarnings()
{
  std::vector<std::string> warnings = input_.takeWarnings();
  for (const std::string& warning : warnings) feed_.warn(warning);
  return warnings;
}
}  // namespace scanloom
