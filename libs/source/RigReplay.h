#pragma once
#include "source/MergedCaptures.h"
#include "source/RigStream.h"

#include <atomic>

namespace scanloom
{
/** A rig's captures through the batcher. */
class RigReplay : public RigInput
{
 public:
  /** Opens the captures; throws what MergedCaptures throws. */
  explicit RigReplay(const Rig&);

  using RigInput::next;
  std::optional<SensorEvent> next(Duration patience) override;
  bool ended() const override { return ended_; }
  void stop() override { stop_ = true; }
  double progress() const override { return captures_.progress(); }
  RigAccount account() const override;
  std::vector<std::string> takeWarnings() override;

  const Batcher& batcher() const { return stream_.batcher(); }
  const PacketRouter& router() const { return stream_.router(); }
  std::uint64_t lateImuSamples() const { return stream_.lateImuSamples(); }

 private:
  MergedCaptures captures_;
  RigStream stream_;
  Datagram datagram_;
  std::atomic<bool> stop_{false};
  bool read_ = false;   // all of the captures
  bool ended_ = false;  // and all was given out
  bool warned_of_cut_ = false;
};
}  // namespace scanloom
