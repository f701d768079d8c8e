/** Shows how much of the input was read: progress for a recording, the lidars' rates for live input; and warnings. */
#pragma once
#include "base/core/Progress.h"
#include "input/rig/internal/LiveStatus.h"

#include <optional>
#include <string>

namespace scanloom
{
class InputDisplay
{
 public:
  using Clock = std::chrono::steady_clock;

  /** For a recording of `total` units; 0: the total is not known, and scans are counted. */
  InputDisplay(const std::string& verb, SensorInput&, std::uint64_t total, const std::string& unit);

  /** For live lidars. */
  InputDisplay(const std::string& verb, SensorInput&);

  InputDisplay(const InputDisplay&) = delete;
  InputDisplay& operator=(const InputDisplay&) = delete;

  /** Does not use the input, which may be gone. */
  ~InputDisplay();

  /** @param share of the input that was read; @param scans so far. Also says the input's warnings. */
  void update(double share, std::uint64_t scans, const Work& = {}, Clock::time_point now = Clock::now());

  /** At once, in a line of its own. */
  void say(const std::string&);

  /** At once; those that come again are counted (RepeatedWarnings). */
  void warn(const std::string&, Clock::time_point now = Clock::now());

 private:
  SensorInput& input_;
  std::uint64_t total_ = 0;
  RepeatedWarnings warnings_;  // of a recording
  Clock::time_point looked_{};
  std::optional<Progress> replay_;
  std::optional<LiveStatus> live_;
};
}  // namespace scanloom
