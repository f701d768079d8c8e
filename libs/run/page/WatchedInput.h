#pragma once
#include "input/rig/ForwardedInput.h"
#include "run/page/internal/LiveFeed.h"

#include <memory>

namespace scanloom
{
/**
 * Another input, whose events a page gets to see on their way to the one who asks for them. Events that a person marks
 * on the page are among them, as those of a recording are.
 */
class WatchedInput : public ForwardedInput
{
 public:
  /** Both must outlive it. */
  WatchedInput(SensorInput& input, LiveFeed& feed) : ForwardedInput(input), feed_(feed) {}

  using SensorInput::next;
  std::optional<SensorEvent> next(Duration patience) override;

  /** The page shows them, too. */
  std::vector<std::string> takeWarnings() override;

 private:
  LiveFeed& feed_;
  RecordingHeader header_;
  LiveFeed::Clock::time_point header_read_{};
};
}  // namespace scanloom
