/** Shows how much of the input was read: progress for a recording, the lidars' rates for live input. */
#pragma once
#include "core/Progress.h"
#include "rig/LiveStatus.h"

#include <optional>
#include <string>

namespace scanloom
{
class InputDisplay
{
 public:
  /** For a recording of `total` units; 0: the total is not known, and scans are counted. */
  InputDisplay(const std::string& verb, std::uint64_t total, const std::string& unit);

  /** For live lidars; the input must outlive it. */
  InputDisplay(const std::string& verb, SensorInput&);

  /** @param share of the input that was read; @param scans so far. */
  void update(double share, std::uint64_t scans, const Work& = {});

 private:
  std::uint64_t total_ = 0;
  SensorInput* input_ = nullptr;  // null: a recording
  std::optional<Progress> replay_;
  std::optional<LiveStatus> live_;
};
}  // namespace scanloom
