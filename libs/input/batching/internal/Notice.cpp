#include "input/batching/internal/Notice.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
// Shorter than any scan: packets did come, but after their deadline.
constexpr Duration kHardlySilent = 50ms;

std::string whatHappened(const Notice& n)
{
  const double duration = seconds(n.duration);
  switch (n.kind)
  {
    case Notice::Kind::Silent:
      return "silent: scans go on without it";
    case Notice::Kind::Back:
      if (n.duration < kHardlySilent) return "back: all its packets had come behind the deadline (deadline_ms)";
      return fmt::format("back after {:.3f} s of silence", duration);
    case Notice::Kind::Restarted:
      return "has started again";
    case Notice::Kind::ClockStepped:
      return fmt::format("its clock stepped by {:+.6f} s", duration);
    case Notice::Kind::ClockAligned:
      return fmt::format(
          "its clock is not that of the others: {:+.6f} s are added to its stamps, judged by their arrival, good to "
          "about a millisecond; synchronise the lidars (PTP) or give its time_offset",
          duration);
    case Notice::Kind::ClockDrifts:
      return fmt::format(
          "its packets' delay changed by {:+.1f} ms against the others': its clock drifts (see to PTP), or its network "
          "or this computer is jammed",
          1e3 * duration);
    case Notice::Kind::Quarantined:
      return fmt::format(
          "its clock is {:+.6f} s off that of the others: left out; synchronise the lidars (PTP), give its "
          "time_offset, or set other_clock = align",
          duration);
    case Notice::Kind::Alert:
      return fmt::format("reports alert flags 0x{:02x}, thermal state {}, shot limiting state {}", n.flags & 0xFF,
                         (n.flags >> 8) & 0xFF, (n.flags >> 16) & 0xFF);
    case Notice::Kind::QueueFull:
      return "more packets wait than queue_packets allows: the oldest are dropped";
  }
  return {};
}
}  // namespace

std::string textOf(const Notice& notice, const std::string& lidar)
{
  return fmt::format("lidar '{}': {}", lidar, whatHappened(notice));
}
}  // namespace scanloom
