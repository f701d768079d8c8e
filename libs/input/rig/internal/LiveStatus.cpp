#include "input/rig/internal/LiveStatus.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace scanloom
{
namespace
{
using namespace std::chrono_literals;

constexpr auto kTerminalPeriod = 1s;
constexpr auto kLogPeriod = 10s;

std::uint64_t packetsBefore(const RigAccount& before, std::size_t lidar)
{
  return lidar < before.lidars.size() ? before.lidars[lidar].counters.packets : 0;
}

std::uint64_t countOf(const RigAccount& account, const std::string& name)
{
  const auto found = account.input.find(name);
  return found == account.input.end() ? 0 : found->second;
}
}  // namespace

LiveStatus::LiveStatus(std::string what, std::ostream& out, bool terminal)
  : what_(std::move(what)), out_(out), terminal_(terminal)
{
}

LiveStatus::~LiveStatus()
{
  for (const std::string& warning : warnings_.unsaid()) say(warning);
  if (line_open_) out_ << std::endl;
}

void LiveStatus::say(const std::string& warning)
{
  if (line_open_) out_ << '\n';
  line_open_ = false;
  out_ << "warning: " << warning << std::endl;
}

void LiveStatus::warn(const std::string& warning, Clock::time_point now)
{
  if (const auto said = warnings_.toSay(warning, now)) say(*said);
}

void LiveStatus::update(SensorInput& input, const Work& work, Clock::time_point now)
{
  for (const std::string& warning : input.takeWarnings()) warn(warning, now);
  if (now - shown_at_ < (terminal_ ? kTerminalPeriod : kLogPeriod)) return;

  const RigAccount account = input.account();
  out_ << (terminal_ ? "\r\033[K" : "") << lineOf(account, work, now) << (terminal_ ? "" : "\n") << std::flush;
  line_open_ = terminal_;
  shown_ = account;
  shown_work_ = work;
  shown_at_ = now;
}

std::string LiveStatus::lineOf(const RigAccount& account, const Work& work, Clock::time_point now) const
{
  const double since = std::chrono::duration<double>(now - shown_at_).count();
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string begin = fmt::format("{}: {}, ", what_, timeText(elapsed)), end = pace(shown_work_, work);
  if (!terminal_) return begin + line(shown_, account, since) + end;
  constexpr std::size_t kWidth = 79;  // a line that is longer than the terminal would not be replaced by the next
  const std::size_t rest = kWidth - std::min(kWidth, begin.size() + end.size());
  return begin + shortLine(shown_, account, since, rest) + end;
}

std::string LiveStatus::shortLine(const RigAccount& before, const RigAccount& now, double seconds, std::size_t width)
{
  std::vector<std::string> rates;
  std::uint64_t lost = 0, late = 0, dropped = countOf(now, "scans_dropped"), packets = 0;
  for (std::size_t i = 0; i < now.lidars.size(); ++i)
  {
    const LidarCounters& c = now.lidars[i].counters;
    const std::uint64_t since = c.packets - packetsBefore(before, i);
    rates.push_back(fmt::format("{} {:.0f}/s", now.lidars[i].name, static_cast<double>(since) / seconds));
    packets += since;
    lost += c.lost;
    late += c.late;
    dropped += c.dropped;
  }
  std::string missing;
  for (const auto& [count, name] : {std::pair(lost, "lost"), std::pair(late, "late"), std::pair(dropped, "dropped")})
    if (count > 0) missing += fmt::format("{}{} {}", missing.empty() ? "; " : ", ", count, name);
  std::string text = fmt::format("{}{}", fmt::join(rates, ", "), missing);
  if (text.size() > width)
    text = fmt::format("{} lidars {:.0f}/s{}", rates.size(), static_cast<double>(packets) / seconds, missing);
  return text.substr(0, width);
}

std::string LiveStatus::line(const RigAccount& before, const RigAccount& now, double seconds)
{
  std::vector<std::string> rates;
  std::uint64_t lost = 0, late = 0, dropped = 0;
  for (std::size_t i = 0; i < now.lidars.size(); ++i)
  {
    const LidarCounters& c = now.lidars[i].counters;
    const auto packets = static_cast<double>(c.packets - packetsBefore(before, i));
    rates.push_back(fmt::format("{} {:.0f}/s", now.lidars[i].name, packets / seconds));
    lost += c.lost;
    late += c.late;
    dropped += c.dropped;
  }
  const std::uint64_t datagrams = countOf(now, "datagrams_dropped") + countOf(now, "datagrams_dropped_by_kernel");
  return fmt::format(
      "{} packets; columns: {} lost, {} late, {} dropped; datagrams: {} dropped; scans: {} waiting, {} dropped",
      fmt::join(rates, ", "), lost, late, dropped, datagrams, now.scans_waiting, countOf(now, "scans_dropped"));
}

std::string LiveStatus::pace(const Work& before, const Work& now)
{
  const double recorded = now.recorded - before.recorded, busy = now.busy - before.busy;
  return recorded > 0 && busy > 0 ? fmt::format("; {:.1f} times real time", recorded / busy) : "";
}
}  // namespace scanloom
