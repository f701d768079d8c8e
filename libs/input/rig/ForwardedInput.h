#pragma once
#include "input/rig/SensorInput.h"

namespace scanloom
{
/** Another input, which somebody watches: next() is his, all else is the other's. */
class ForwardedInput : public SensorInput
{
 public:
  /** It must outlive this. */
  explicit ForwardedInput(SensorInput& input) : input_(input) {}

  using SensorInput::next;
  bool ended() const override { return input_.ended(); }
  void stop() override { input_.stop(); }
  SensorSetup setup() const override { return input_.setup(); }
  double progress() const override { return input_.progress(); }
  RigAccount account() const override { return input_.account(); }
  std::map<std::string, StageTime> stages() const override { return input_.stages(); }
  std::vector<std::string> takeWarnings() override { return input_.takeWarnings(); }

 protected:
  SensorInput& input_;
};
}  // namespace scanloom
