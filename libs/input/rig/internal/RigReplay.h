#pragma once
#include "input/rig/Rig.h"
#include "input/rig/internal/PacedCaptures.h"
#include "input/rig/internal/RigStream.h"

#include <atomic>

namespace scanloom
{
/** A rig's captures through the batcher, as fast as events are taken. */
class RigReplay : public SensorInput
{
 public:
  /** Opens the captures; throws what MergedCaptures throws. */
  explicit RigReplay(const Rig&);

  using SensorInput::next;
  std::optional<SensorEvent> next(Duration patience) override;
  bool ended() const override { return ended_; }
  void stop() override { stop_ = true; }
  SensorSetup setup() const override { return setup_; }
  double progress() const override { return captures_.progress(); }
  RigAccount account() const override;
  std::vector<std::string> takeWarnings() override;

 private:
  SensorSetup setup_;
  PacedCaptures captures_;
  RigStream stream_;
  Datagram datagram_;  // its memory serves for the next one
  std::atomic<bool> stop_{false};
  bool read_ = false;   // the captures are at their end
  bool ended_ = false;  // and every event was given out
};
}  // namespace scanloom
