#include "base/core/Progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
using namespace std::chrono_literals;

constexpr auto kTerminalPeriod = 100ms;
constexpr auto kLogPeriod = 10s;  // if the total is not known
constexpr std::size_t kBarWidth = 20;
constexpr std::size_t kTerminalWidth = 79;  // a line that is longer would not be replaced by the next
constexpr const char* kBackAndErase = "\r\033[K";

std::string bar(double share, std::size_t width)
{
  const auto filled = static_cast<std::size_t>(share * static_cast<double>(width));
  return "[" + std::string(filled, '=') + std::string(width - filled, ' ') + "] ";
}
}  // namespace

bool standardErrorIsTerminal() { return ::isatty(STDERR_FILENO) == 1; }

Progress::Progress(std::string what, std::uint64_t total, std::string unit, std::ostream& out, bool terminal)
  : what_(std::move(what)), total_(total), unit_(std::move(unit)), out_(out), terminal_(terminal)
{
}

Progress::~Progress()
{
  if (terminal_ || done_ != shown_) show();
  if (terminal_) out_ << std::endl;
}

void Progress::update(std::uint64_t done)
{
  done_ = total_ > 0 ? std::min(done, total_) : done;
  if (isTimeToShow()) show();
}

bool Progress::isTimeToShow() const
{
  const auto since = Clock::now() - shown_at_;
  if (terminal_) return since >= kTerminalPeriod;
  if (total_ == 0) return since >= kLogPeriod;
  const auto tenths = [this](std::uint64_t count) { return count * 10 / total_; };
  return tenths(done_) > tenths(shown_);
}

void Progress::show()
{
  shown_ = done_;
  shown_at_ = Clock::now();
  if (terminal_)
    out_ << kBackAndErase << line() << std::flush;
  else
    out_ << line() << std::endl;
}

void Progress::say(const std::string& text)
{
  out_ << (terminal_ ? kBackAndErase : "") << text << std::endl;
  if (terminal_) show();
}

std::string Progress::line() const
{
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  const double rate = elapsed > 0 ? static_cast<double>(done_) / elapsed : 0.0;
  const std::string speed = fmt::format("{:.1f} {}/s", rate, unit_);
  if (total_ == 0) return fmt::format("{}: {} {}, {}", what_, done_, unit_, speed);

  const double share = static_cast<double>(done_) / static_cast<double>(total_);
  const std::string time = done_ == total_ ? "took " + timeText(elapsed)
                           : rate > 0      ? timeText(static_cast<double>(total_ - done_) / rate) + " left"
                                           : "starting";
  const std::string numbers = fmt::format("{:.0f} %, {}/{} {}, {}, {}", 100 * share, done_, total_, unit_, speed, time);
  if (!terminal_) return fmt::format("{}: {}", what_, numbers);
  constexpr std::size_t kFrame = 5;  // ": ", brackets and a blank
  const std::size_t taken = what_.size() + kFrame + numbers.size();
  const std::string drawn = bar(share, std::min(kBarWidth, kTerminalWidth - std::min(kTerminalWidth, taken)));
  return fmt::format("{}: {}{}", what_, drawn, numbers).substr(0, kTerminalWidth);
}

std::uint64_t megabytesOf(const std::vector<std::filesystem::path>& files)
{
  std::uintmax_t bytes = 0;
  const auto add = [&](const std::filesystem::path& file)
  {
    std::error_code missing;
    const std::uintmax_t size = std::filesystem::file_size(file, missing);
    if (!missing) bytes += size;
  };
  for (const auto& file : files)
    if (std::filesystem::is_directory(file))
      for (const auto& part : std::filesystem::directory_iterator(file)) add(part);
    else
      add(file);
  return std::max<std::uint64_t>(1, bytes / 1000000);
}

std::string timeText(double seconds)
{
  const auto whole = std::llround(std::max(0.0, seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole % 3600 / 60);
}
}  // namespace scanloom
