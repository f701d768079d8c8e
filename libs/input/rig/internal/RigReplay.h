#pragma once
#include "input/packets/MergedCaptures.h"
#include "input/rig/Rig.h"
#include "input/rig/RigStream.h"

#include <atomic>

namespace scanloom
{
/**
 * A rig's captures through the batcher, as fast as events are taken. Of the members the first half, up to datagram_, is
 * the way from the files to the batcher; the other half is how far it has come and what of it was told.
 */
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
  bool readDatagram();

  SensorSetup setup_;
  MergedCaptures captures_;
  RigStream stream_;
  std::vector<Datagram> first_;  // that were read to tell the pace of their times
  std::size_t taken_ = 0;        // of them
  double pace_ = 1;              // of times of reception
  Timestamp begin_;              // the first of these times
  Datagram datagram_;
  std::atomic<bool> stop_{false};
  bool read_ = false;               // the captures are at their end
  bool ended_ = false;              // and every event was given out
  std::vector<std::string> notes_;  // of the rig, until takeWarnings() gives them
  bool warned_of_cut_ = false;
  std::size_t warned_of_damages_ = 0;
};
}  // namespace scanloom
