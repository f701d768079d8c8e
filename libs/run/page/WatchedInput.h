#pragma once
#include "run/page/internal/LiveFeed.h"

#include <memory>

namespace scanloom
{
/**
 * Another input, whose events a page gets to see on their way to the one who asks for them. Events that a person marks
 * on the page are among them, as those of a recording are.
 */
class WatchedInput : public SensorInput
{
 public:
  /** Both must outlive it. */
  WatchedInput(SensorInput& input, LiveFeed& feed) : input_(input), feed_(feed) {}

  using SensorInput::next;
  std::optional<SensorEvent> next(Duration patience) override;
  bool ended() const override { return input_.ended(); }
  void stop() override { input_.stop(); }
  SensorSetup setup() const override { return input_.setup(); }
  double progress() const override { return input_.progress(); }
  RigAccount account() const override { return input_.account(); }
  std::map<std::string, StageTime> stages() const override { return input_.stages(); }

  /** The page shows them, too. */
  std::vector<std::string> takeWarnings() override;

 private:
  SensorInput& input_;
  LiveFeed& feed_;
  RecordingHeader header_;
  LiveFeed::Clock::time_point header_read_{};
};
}  // namespace scanloom
